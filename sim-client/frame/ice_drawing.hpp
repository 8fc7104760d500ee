#pragma once
/// Still ice as a screen draws it: slabs move with the vehicle that they lie on; icicles and sheets are built once per
/// keyframe, and those near the eye are drawn. One thread.

#include <optional>
#include <vector>

#include "engine/effects/ice/ice_keyframe.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::frame {

/// Slab of ice on its vehicle, at its present thickness: like the piece of debris that it will become, with the same
/// cracks in the same places.
ice::IceBody slab_body(const ice::LyingSlab& slab, double thawed_kh, const RigidTransform& world_from_vehicle,
                       float film);
/// All icicles of a row in one body; without vertices if no icicle is left.
ice::IceBody row_body(const ice::IcicleRow& row, double thawed_kh, float film);
/// Sheet in bodies of some metres each.
std::vector<ice::IceBody> sheet_bodies(const ice::Sheet& sheet, double thawed_kh, float film);

class IceDrawing {
 public:
  void show(const Snapshot& instant, const scene::ResolvedScene& scene);
  void add_to(instant::FrameInput& frame) const;

 private:
  struct Standing {
    ice::IceBody body;
    double reach_m = 0.0;  ///< Distance up to which it is drawn.
  };
  Tick tick_ = 0;  ///< Tick of the latest keyframe.
  float film_ = 0.0f;
  std::optional<ice::StillIce> ice_;
  std::vector<Standing> standing_;
  std::vector<ice::IceBody> slabs_;
  std::vector<instant::DynamicMesh> shadows_;  ///< Shadow meshes of the slabs.
};

}  // namespace septet::frame
