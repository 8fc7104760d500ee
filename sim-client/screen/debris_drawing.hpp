#pragma once
/// Debris between two keyframes: vertices interpolated, faces with the normals that their triangles have there.
///
/// Two keyframes with the same triangles: every vertex goes straight from one to the other, and each face's normal is the
/// cross product of its interpolated edges, which is the exact normal at that instant and not a blend of two. Where the
/// triangles differ the piece has broken: until the later one's instant the earlier one flies on as it flew. One thread.

#include <map>
#include <span>
#include <vector>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/render/frame_input.hpp"
#include "sim-client/screen/effect_playout.hpp"

namespace septet::screen {

/// A piece as it stands at one instant.
struct DebrisShape {
  debris::Part part = debris::Part::bumper;
  debris::Material material = debris::Material::bumper_plastic;
  bool both_sides = false;
  std::vector<Vec3> vertices_m;  ///< World.
  std::vector<std::array<std::uint16_t, 3>> triangles;
};

/// A keyframe with the tick that it shows.
struct TimedDebris {
  const debris::Keyframe* keyframe = nullptr;  ///< Null: there is none.
  Tick tick = 0;
};

/// What is seen at `tick` (a fraction lies between two ticks); nothing where there is no keyframe at all.
std::optional<DebrisShape> debris_at(const TimedDebris& earlier, const TimedDebris& before, const TimedDebris& after, double tick);

/// Triangles with their face normals, relative to their middle; a shape without area has none.
render::DynamicMesh debris_mesh(const DebrisShape& shape);

/// Name of the prototype whose material a piece wears: "debris/ice".
std::string_view debris_look(debris::Part part, debris::Material material);

class DebrisDrawing {
 public:
  /// All debris of the moments, ready for a frame.
  std::vector<render::DynamicMesh> draw(std::span<const EffectMoment> moments, double tick, const scene::ResolvedScene& scene);
  /// Keyframes that could not be read.
  std::uint32_t refused() const { return refused_; }

 private:
  using Key = std::pair<std::uint32_t, Tick>;
  struct Decoded {
    std::optional<debris::Keyframe> keyframe;
    bool used = false;
  };
  TimedDebris decoded(const EffectKeyframe* effect);

  std::map<Key, Decoded> decoded_;  ///< Each keyframe is read once.
  std::uint32_t refused_ = 0;
};

}  // namespace septet::screen
