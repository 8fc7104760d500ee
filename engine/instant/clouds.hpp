#pragma once
/// Noise of the clouds (engine/light/clouds.hpp), and their drift: with the wind, at twice its speed near the ground.

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "engine/instant/atmosphere.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::instant {

/// Side of the tile of noise, which repeats at its edges.
inline constexpr std::uint32_t cloud_noise_side = 512;

/// Six octaves of value noise as ranks of 8 bits, row after row. Takes milliseconds: made once and kept.
std::vector<std::uint8_t> cloud_noise();

/// Drift of the clouds at an instant, m along x and y, within a tile.
glm::vec2 cloud_drift_m(const Environment& environment, double simulated_time_s);

/// Rank at a place, in tiles, interpolated between the four texels around it: 0 to 1.
float cloud_rank(std::span<const std::uint8_t> noise, const glm::vec2& at);

struct CloudSeen {
  glm::vec3 radiance{0.0f};
  float cover = 0.0f;  ///< Share of the background that it hides.
};

/// Cloud in a unit direction.
CloudSeen cloud_seen(std::span<const std::uint8_t> noise, const SkyLight& sky, double cloud_cover,
                     const glm::vec2& drift_m, const glm::vec3& direction);

}  // namespace septet::instant
