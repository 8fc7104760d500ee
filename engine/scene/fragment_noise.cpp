#include "engine/scene/fragment_noise.hpp"

#include <array>
#include <cstdint>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace septet::scene {
namespace {

constexpr float farthest = 1e6f;

struct Cell {
  std::int32_t x, y, z;
};

std::uint32_t hash_of(const Cell& cell) {
  std::uint32_t h = static_cast<std::uint32_t>(cell.x) * 0x9E3779B1u ^
                    static_cast<std::uint32_t>(cell.y) * 0x85EBCA77u ^ static_cast<std::uint32_t>(cell.z) * 0xC2B2AE3Du;
  h = (h ^ (h >> 15)) * 0x2C1B3C6Du;
  h = (h ^ (h >> 12)) * 0x297A2D39u;
  return h ^ (h >> 15);
}

float gradient_at(const Cell& cell, const glm::vec3& from_corner) {
  static constexpr std::array<glm::vec3, 12> gradients{{{1, 1, 0},
                                                        {-1, 1, 0},
                                                        {1, -1, 0},
                                                        {-1, -1, 0},
                                                        {1, 0, 1},
                                                        {-1, 0, 1},
                                                        {1, 0, -1},
                                                        {-1, 0, -1},
                                                        {0, 1, 1},
                                                        {0, -1, 1},
                                                        {0, 1, -1},
                                                        {0, -1, -1}}};
  return glm::dot(gradients[hash_of(cell) % gradients.size()], from_corner);
}

float perlin(const Cell& cell, const glm::vec3& within) {
  const glm::vec3 share = within * within * within * (within * (within * 6.0f - 15.0f) + 10.0f);
  const auto corner = [&](std::int32_t x, std::int32_t y, std::int32_t z) {
    return gradient_at({cell.x + x, cell.y + y, cell.z + z}, within - glm::vec3(x, y, z));
  };
  const auto along_x = [&](std::int32_t y, std::int32_t z) {
    return glm::mix(corner(0, y, z), corner(1, y, z), share.x);
  };
  return glm::mix(glm::mix(along_x(0, 0), along_x(1, 0), share.y), glm::mix(along_x(0, 1), along_x(1, 1), share.y),
                  share.z);
}

}  // namespace

float noise_at(NoiseKind kind, const glm::vec3& place) {
  const auto near = [](float value) { return value > -farthest ? glm::min(value, farthest) : -farthest; };
  const glm::vec3 at(near(place.x), near(place.y), near(place.z));
  const glm::vec3 low = glm::floor(at);
  const Cell cell{static_cast<std::int32_t>(low.x), static_cast<std::int32_t>(low.y), static_cast<std::int32_t>(low.z)};
  const bool smooth = kind == NoiseKind::perlin_zero_to_one || kind == NoiseKind::perlin_minus_one_to_one;
  const float value = smooth ? glm::clamp(perlin(cell, at - low), -1.0f, 1.0f)
                             : static_cast<float>(hash_of(cell) >> 8) / 8388607.5f - 1.0f;
  const bool positive = kind == NoiseKind::perlin_zero_to_one || kind == NoiseKind::point_zero_to_one;
  return positive ? 0.5f + 0.5f * value : value;
}

}  // namespace septet::scene
