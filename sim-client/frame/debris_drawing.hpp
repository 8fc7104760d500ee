#pragma once
/// Debris between two keyframes, a vehicle's part in the form and colour that it had there (clothing.hpp): vertices interpolated, faces with the exact normals that their triangles have there, and
/// where a part is bent or round corners with the normals of the faces around them (bent_normals.hpp).
///
/// Two keyframes with the same triangles: every vertex moves straight from one to the other, and each face's normal is
/// the t-variant cross product (engine/geometry/temporal_normals.hpp), whose coefficients are computed once per pair; a
/// frame only evaluates them. Different triangles mean that the piece has broken: until the later one's instant the
/// earlier one is extrapolated. One thread.

#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/geometry/temporal_normals.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/instant/ice_body.hpp"
#include "sim-client/frame/bent_normals.hpp"
#include "sim-client/frame/clothing.hpp"
#include "sim-client/frame/effect_playout.hpp"

namespace septet::frame {

/// Keyframe with its tick.
struct TimedDebris {
  const debris::Keyframe* keyframe = nullptr;  ///< Null: no keyframe.
  Tick tick = 0;
  std::shared_ptr<const Clothing> clothing = nullptr;  ///< Of the vertices of a keyframe that wears a panel.
};

/// Keyframes around an instant, and the fraction between them: 0 at `from`, 1 at `to`, more if it is extrapolated.
struct DebrisInstant {
  TimedDebris from, to;
  double share = 0.0;
};

/// Keyframes for `tick` (a fraction lies between two ticks); empty if there is no keyframe.
std::optional<DebrisInstant> debris_instant(const TimedDebris& earlier, const TimedDebris& before,
                                            const TimedDebris& after, double tick);

/// Motion of a piece between two keyframes with the same triangles: everything independent of the instant.
class DebrisWay {
 public:
  DebrisWay(const debris::Keyframe& from, const debris::Keyframe& to);

  /// Triangles with their face normals, relative to their middle; a shape without triangles has no vertices.
  instant::DynamicMesh at(double share) const;
  debris::Part part() const { return part_; }
  debris::Material material() const { return material_; }
  /// Same triangles as transparent ice, with the cracks of their crack field; empty for other materials. `mesh` is the
  /// result of `at`; `film`: ice_looks.hpp.
  std::optional<ice::IceBody> ice_of(const instant::DynamicMesh& mesh, float film) const;

 private:
  debris::Part part_;
  debris::Material material_;
  bool both_sides_;
  std::vector<Vec3> rest_m_;            ///< Per vertex; only for ice.
  std::vector<ice::IceVertex> inside_;  ///< Vertices in the frame at rest.
  std::vector<debris::Keyframe::Crack> cracks_;
  std::vector<Vec3> from_m_, step_m_;  ///< World; each vertex' place and its step to the next.
  std::vector<std::array<std::uint16_t, 3>> triangles_;
  TemporalNormals normals_;
  std::optional<BentNormals> bent_;  ///< Empty: shards and ice, whose faces are flat.
};

/// Name of the prototype that gives a piece its material: "debris/ice".
std::string_view debris_look(debris::Part part, debris::Material material);

/// Debris of a frame: bodies in `ice` are among the meshes as well, for their shadow.
struct DrawnDebris {
  std::vector<instant::DynamicMesh> meshes;
  std::vector<ice::IceBody> ice;
};

class DebrisDrawing {
 public:
  /// All debris of the moments, ready for a frame.
  DrawnDebris draw(std::span<const EffectMoment> moments, double tick, const scene::ResolvedScene& scene,
                   double temperature_k = 268.15);
  /// Pairs of keyframes with computed normals so far.
  std::uint32_t prepared() const { return prepared_; }

 private:
  using Key = std::pair<std::uint32_t, Tick>;
  struct Decoded {
    std::optional<debris::Keyframe> keyframe;
    std::shared_ptr<const Clothing> clothing;
    bool used = false;
  };
  using WayKey = std::tuple<std::uint32_t, Tick, Tick>;
  struct Prepared {
    DebrisWay way;
    std::optional<debris::PieceOrigin> origin;
    std::shared_ptr<const Clothing> clothing;
    bool used = false;
  };
  struct Worn {
    std::shared_ptr<const Clothing> clothing;
    bool used = false;
  };
  TimedDebris decoded(const EffectKeyframe* effect, const scene::ResolvedScene& scene);
  /// The clothing of a piece of a vehicle; null where it wears nothing.
  std::shared_ptr<const Clothing> clothing_of(std::uint32_t id, const debris::Keyframe& piece,
                                              const scene::ResolvedScene& scene);
  const Sheet& panel(const debris::PieceOrigin& origin, const scene::ResolvedScene& scene);

  std::map<Key, Decoded> decoded_;      ///< Cache: each keyframe is read once.
  std::map<WayKey, Prepared> ways_;     ///< Cache: each pair is prepared once.
  std::map<std::uint32_t, Worn> worn_;  ///< Cache, by effect: until the piece breaks.
  std::map<std::pair<ModelIndex, debris::Mount>, Sheet> panels_;
  std::uint64_t scene_revision_ = 0;
  std::uint32_t prepared_ = 0;
};

}  // namespace septet::frame
