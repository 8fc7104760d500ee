#pragma once
/// Frost and crack stars on windscreens: on the driver's own where the inside of the car is drawn (in a rig the glass
/// is a real car's), and on those of visible cars whose mesh has glass. One thread.

#include <cstdint>
#include <map>
#include <vector>

#include "engine/core/bytes.hpp"
#include "engine/effects/ice/glass.hpp"
#include "engine/instant/frame_input.hpp"

namespace septet::frame {

/// Windscreen of a vehicle, from its prototype: dark, smooth triangles that face forward. Empty if it has none.
ice::PaneShape windscreen_of(const scene::ResolvedScene& scene, const scene::Prototype& prototype);

class GlassDrawing {
 public:
  /// Updates from the keyframe of the instant, if it can be read.
  void show(const Snapshot& instant, const scene::ResolvedScene& scene);
  /// Adds frost and cracks to the participants of the frame.
  void add_to(instant::FrameInput& frame) const;

 private:
  struct Surfaces {
    ice::PaneShape shape;
    std::vector<ice::IceVertex> frost, cracks;  ///< Vehicle frame.
  };
  struct Made {
    ice::Pane pane;
    RigidTransform world_from_vehicle;
    std::map<std::uint32_t, Surfaces> by_prototype;  ///< Prototypes of its inside and of its outside.
    bool shown = false;
  };
  void make(Made& made, const Participant& vehicle, const scene::ResolvedScene& scene) const;

  std::map<ParticipantId, Made> made_;  ///< Cache: rebuilt when they change.
  std::vector<ice::Pane> panes_;
  Bytes data_;  ///< Bytes of the keyframe that they were read from.
  std::uint64_t scene_revision_ = 0;
};

}  // namespace septet::frame
