#pragma once
/// Debris between two keyframes: vertices interpolated, faces with the exact normals that their triangles have there.
///
/// Two keyframes with the same triangles: every vertex goes straight from one to the other, and each face's normal is the
/// t-variant cross product (engine/geometry/temporal_normals.hpp), whose coefficients are worked out once for the two; a
/// frame only evaluates them. Where the triangles differ the piece has broken: until the later one's instant the earlier one
/// flies on as it flew. One thread.

#include <map>
#include <span>
#include <tuple>
#include <vector>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/geometry/temporal_normals.hpp"
#include "engine/instant/frame_input.hpp"
#include "engine/instant/ice_body.hpp"
#include "sim-client/frame/effect_playout.hpp"

namespace septet::frame {

/// A keyframe with the tick that it shows.
struct TimedDebris {
  const debris::Keyframe* keyframe = nullptr;  ///< Null: there is none.
  Tick tick = 0;
};

/// Between which keyframes a piece is seen, and how far on its way: 0 at `from`, 1 at `to`, more where it flies on.
struct DebrisInstant {
  TimedDebris from, to;
  double share = 0.0;
};

/// What is seen at `tick` (a fraction lies between two ticks); nothing where there is no keyframe at all.
std::optional<DebrisInstant> debris_instant(const TimedDebris& earlier, const TimedDebris& before,
                                            const TimedDebris& after, double tick);

/// The way of a piece between two keyframes with the same triangles: all that does not depend on the instant.
class DebrisWay {
 public:
  DebrisWay(const debris::Keyframe& from, const debris::Keyframe& to);

  /// Triangles with their face normals, relative to their middle; a shape without triangles has no vertices.
  instant::DynamicMesh at(double share) const;
  debris::Part part() const { return part_; }
  debris::Material material() const { return material_; }
  /// The same triangles as ice to see through, with the cracks of the field that they lie in; nothing where they are of
  /// something else. `mesh` is what `at` gave; `film`: ice_looks.hpp.
  std::optional<ice::IceBody> ice_of(const instant::DynamicMesh& mesh, float film) const;

 private:
  debris::Part part_;
  debris::Material material_;
  bool both_sides_;
  std::vector<Vec3> rest_m_;            ///< Of each vertex; only of ice.
  std::vector<ice::IceVertex> inside_;  ///< In the frame at rest.
  std::vector<debris::Keyframe::Crack> cracks_;
  std::vector<Vec3> from_m_, step_m_;  ///< World; each vertex' place and the way to its next.
  std::vector<std::array<std::uint16_t, 3>> triangles_;
  TemporalNormals normals_;
};

/// Name of the prototype whose material a piece wears: "debris/ice".
std::string_view debris_look(debris::Part part, debris::Material material);

/// Debris as a frame shows it: what is `ice` is among the meshes as well, for its shadow.
struct DrawnDebris {
  std::vector<instant::DynamicMesh> meshes;
  std::vector<ice::IceBody> ice;
};

class DebrisDrawing {
 public:
  /// All debris of the moments, ready for a frame.
  DrawnDebris draw(std::span<const EffectMoment> moments, double tick, const scene::ResolvedScene& scene,
                   double temperature_k = 268.15);
  /// Keyframes that could not be read.
  std::uint32_t refused() const { return refused_; }
  /// Pairs of keyframes whose normals were worked out so far.
  std::uint32_t prepared() const { return prepared_; }

 private:
  using Key = std::pair<std::uint32_t, Tick>;
  struct Decoded {
    std::optional<debris::Keyframe> keyframe;
    bool used = false;
  };
  using WayKey = std::tuple<std::uint32_t, Tick, Tick>;
  struct Prepared {
    DebrisWay way;
    bool used = false;
  };
  TimedDebris decoded(const EffectKeyframe* effect);

  std::map<Key, Decoded> decoded_;   ///< Each keyframe is read once.
  std::map<WayKey, Prepared> ways_;  ///< Each pair is worked out once.
  std::uint32_t refused_ = 0, prepared_ = 0;
};

}  // namespace septet::frame
