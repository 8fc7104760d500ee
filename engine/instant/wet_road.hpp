#pragma once
/// Water on a road: the plane that it mirrors in, the places of puddles, and the rings of rain on them. For the look of
/// wet asphalt see engine/light/wet_road.hpp.
///
/// Rings: of the drops above 2 mm (Marshall and Palmer 1948), each a train of waves that runs outwards at 0.23 m/s, the
/// lowest speed of waves on water, and is gone after half a second. They lie in a tile of a metre that repeats, and are
/// a function of rain and time alone.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/instant/frame_input.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// Road near the eye, as a plane.
struct RoadPlane {
  Vec3 point_m{0.0};
  glm::vec3 normal{0.0f, 0.0f, 1.0f};  ///< Unit, up.
};

/// Road under the vehicle that is nearest to the eye, by its wheels; empty if no vehicle stands below the eye within 80
/// m.
std::optional<RoadPlane> road_below(std::span<const DrawnParticipant> participants,
                                    std::span<const scene::Prototype> prototypes, const Vec3& eye_m);

/// Share of a place under water, 0 to 1: light::puddle_at. `noise`: cloud_noise(), over the world. `rut`: 1 where
/// wheels run.
float puddle(std::span<const std::uint8_t> noise, double x_m, double y_m, float rut, float wetness);

inline constexpr std::uint32_t ripple_side = 128;

/// Slopes of water along x and y at an instant within light::ripple_tile_m, row after row; level without rain.
std::vector<glm::vec2> ripple_slopes(double rain_mm_per_h, double simulated_time_s);

}  // namespace septet::instant
