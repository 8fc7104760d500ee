#pragma once
/// Lamps that stand and shine down: those of streets and the rows below a tunnel's ceiling, found in the scene by what they are,
/// triangles with an emission that look down.
///
/// One under a roof shines like a matt lamp: its intensity falls with the cosine from straight down. One in the open spreads its light as
/// engine/world/street_lamp.hpp says. Nights and roofed places are shown as if all of
/// their light were so many times brighter, so that a display need not show starlight (see Instant::headlights); what these lamps light keeps pace.

#include <array>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/atmosphere.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// An upright wall beside a lamp, seen from above: its light goes no further along `way` than `distance_m`.
struct LampWall {
  glm::vec2 way{0.0f};
  float distance_m = std::numeric_limits<float>::infinity();
};

struct StandingLamp {
  Vec3 position_m{0.0};       ///< World.
  float height_m = 5.0f;      ///< Above the ground below it.
  glm::vec3 intensity{0.0f};  ///< Straight down: its emission times its area.
  bool roofed = false;        ///< It lights what stands under its roof, and nothing else.
  /// Of a roofed one the nearest wall, and the nearest of those that face it.
  std::array<LampWall, 2> walls{};
};

/// How many times as strongly they light, as their emission says. Measured in scenarios/tunnel-fire 7.8 s after its beginning.
inline constexpr float roofed_lamps_light_up = 6.0f;
/// Of those in the open: as much as all light there, as far as they are lit.
inline float open_lamps_light_up(const SkyLight& light) { return glm::mix(1.0f, light.light_up, light.street_lamps); }

/// A normal that looks down as a lamp's does.
inline bool looks_down(const glm::vec3& normal) { return normal.z < -0.9f; }

/// One for each pair of triangles or so; of what moves (prototypes) none.
std::vector<StandingLamp> standing_lamps(const scene::ResolvedScene& scene);

}  // namespace septet::instant
