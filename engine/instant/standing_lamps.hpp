#pragma once
/// Static lamps that shine down: street lamps and the rows below a tunnel's ceiling, found in the scene as triangles
/// with an emission that face down.
///
/// A lamp under a roof shines like a matt one: its intensity falls with the cosine from straight down. A lamp in the
/// open spreads its light as in engine/world/street_lamp.hpp. Nights and roofed places are shown as if all of their
/// light were so many times brighter, so that a display need not show starlight (see Instant::headlights); the light of
/// these lamps is scaled likewise.

#include <array>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "engine/instant/atmosphere.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// Upright wall beside a lamp, seen from above: its light goes no further along `way` than `distance_m`.
struct LampWall {
  glm::vec2 way{0.0f};
  float distance_m = std::numeric_limits<float>::infinity();
};

struct StandingLamp {
  Vec3 position_m{0.0};       ///< World.
  float height_m = 5.0f;      ///< Height above the ground below it.
  glm::vec3 intensity{0.0f};  ///< Intensity straight down: its emission times its area.
  bool roofed = false;        ///< True if it lights only places under its roof.
  /// Nearest wall of a roofed lamp, and the nearest on the opposite side.
  std::array<LampWall, 2> walls{};
};

/// Factor of their light over that of their emission. Measured in scenarios/tunnel-fire 7.8 s after its beginning.
inline constexpr float roofed_lamps_light_up = 6.0f;
/// Factor of lamps in the open: that of all light there, by the share to which they are lit.
inline float open_lamps_light_up(const SkyLight& light) { return glm::mix(1.0f, light.light_up, light.street_lamps); }

/// True for a normal that faces down as a lamp's does.
inline bool looks_down(const glm::vec3& normal) { return normal.z < -0.9f; }

/// Lamps of a scene, about one a pair of triangles; moving lamps (prototypes) are not included.
std::vector<StandingLamp> standing_lamps(const scene::ResolvedScene& scene);

}  // namespace septet::instant
