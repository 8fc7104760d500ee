#pragma once
/// Triangles for eight paths at once: flat, matt and static, one cache line each.

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/raytrace/eight.hpp"

namespace septet::raytrace {

/// Frame: that of World.
struct alignas(64) Face {
  glm::vec3 corner_m{0.0f}, second{0.0f}, third{0.0f};  ///< `second`, `third`: from the first corner to the others.
  glm::vec3 normal{0.0f};                               ///< Unit.
  glm::vec3 color{0.0f};                                ///< Albedo; radiance of a lamp.
  static constexpr float front_side = 1.0f, both_sides = 2.0f;
  /// Side constant of a matt triangle; 0: not matt. Total area of the lamp, m², for a lamp's triangle.
  float number = 0.0f;
};
static_assert(sizeof(Face) == 16 * sizeof(float));

/// Eight faces, transposed.
struct Face8 {
  Vec8 corner_m, second, third, normal, color;
  Float8 number;

  explicit Face8(const Face* const (&faces)[8]) {
    const float* rows[8];
    Float8 low[8], high[8];
    for (int n = 0; n < 8; ++n) rows[n] = &faces[n]->corner_m.x;
    transpose(rows, low);
    for (int n = 0; n < 8; ++n) rows[n] += 8;
    transpose(rows, high);
    corner_m = {low[0], low[1], low[2]}, second = {low[3], low[4], low[5]}, third = {low[6], low[7], high[0]};
    normal = {high[1], high[2], high[3]}, color = {high[4], high[5], high[6]};
    number = high[7];
  }
};

struct MattFaces {
  static constexpr std::uint32_t none = 0xffffffffu;
  std::vector<Face> faces;
  std::vector<std::uint32_t> first_of_place;  ///< Index of its first triangle by place, or `none`.
  std::vector<Face> lamps;                    ///< Triangles of all lamps.
  std::vector<std::uint32_t> first_of_lamp;

  const Face& at(std::uint32_t place, std::uint32_t triangle) const {
    const std::uint32_t first = first_of_place[place];
    return first == none ? other : faces[std::size_t{first} + triangle];
  }
  Face other;  ///< Stands for all triangles that are not matt.
};

}  // namespace septet::raytrace
