#include "engine/effects/ice/cracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/random.hpp"

namespace septet::ice {
namespace {

glm::mat3 any_turn(Random& random) {
  // Shoemake, "Uniform random rotations" (1992).
  const double u = random.uniform(), a = random.uniform(0.0, 6.283185307), b = random.uniform(0.0, 6.283185307);
  const double s = std::sqrt(1.0 - u), t = std::sqrt(u);
  return glm::mat3_cast(glm::quat(glm::dquat(t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b))));
}

Crack any_crack(Random& random, const glm::vec3& middle_m, float size_m) {
  Crack crack;
  crack.middle_m = middle_m;
  crack.turn = any_turn(random);
  crack.size_m = size_m;
  crack.bend = static_cast<float>(random.uniform(0.05, 0.25));
  crack.seed = static_cast<float>(random.uniform());
  return crack;
}

/// Cell index of a coordinate in cells. NaN, or a place beyond every cell, counts as in the last.
int cell_of(float at) {
  constexpr float furthest = 1 << 20;
  return static_cast<int>(std::max(-furthest, std::min(furthest, std::floor(at))));
}

}  // namespace

std::vector<Crack> generic_cracks(const Box& box, std::uint32_t count, std::uint64_t seed) {
  Random random(seed, 1);
  const glm::vec3 extent = box.max_m - box.min_m, middle = 0.5f * (box.min_m + box.max_m);
  std::vector<Crack> cracks;
  for (std::uint32_t i = 0; i < count; ++i) {
    glm::vec3 off;
    for (int c = 0; c < 3; ++c) off[c] = static_cast<float>(random.uniform(-0.22, 0.22)) * extent[c];
    cracks.push_back(any_crack(random, middle + off, 1.2f * glm::length(extent)));
  }
  return cracks;
}

std::vector<Crack> cracks_in(const Box& rest_box, float cell_m) {
  constexpr int most_cells = 512;
  std::array<int, 3> low{}, high{};
  for (int c = 0; c < 3; ++c) {
    // A crack reaches over its cell's border by less than a cell.
    low[static_cast<std::size_t>(c)] = cell_of(rest_box.min_m[c] / cell_m - 0.8f);
    high[static_cast<std::size_t>(c)] = cell_of(rest_box.max_m[c] / cell_m + 0.8f);
  }
  std::vector<Crack> cracks;
  int cells = 0;
  for (int z = low[2]; z <= high[2]; ++z)
    for (int y = low[1]; y <= high[1]; ++y)
      for (int x = low[0]; x <= high[0]; ++x) {
        if (++cells > most_cells) return cracks;
        const auto key = [](int v) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v)); };
        Random random(key(x) | key(y) << 32, key(z));
        glm::vec3 at;
        for (int c = 0; c < 3; ++c) at[c] = static_cast<float>(random.uniform());
        const auto size = static_cast<float>(random.uniform(0.6, 1.0));
        const Crack crack = any_crack(random, (glm::vec3(x, y, z) + at) * cell_m, size * cell_m);
        // Its corners lie √½ of its size from its middle, and it bends.
        const glm::vec3 nearest = glm::clamp(crack.middle_m, rest_box.min_m, rest_box.max_m);
        const bool reaches = glm::length(crack.middle_m - nearest) < 0.8f * crack.size_m;
        if (random.uniform() < 0.6 && reaches) cracks.push_back(crack);
      }
  return cracks;
}

void append_crack(std::vector<IceVertex>& inside, const Crack& crack, InsideKind kind, std::uint32_t cells) {
  std::vector<IceVertex> grid;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) {
      const float u = 2.0f * static_cast<float>(i) / static_cast<float>(cells) - 1.0f,
                  v = 2.0f * static_cast<float>(j) / static_cast<float>(cells) - 1.0f;
      // A saddle and a bowl, so that no two places have one normal.
      const float height = crack.bend * (1.0f - 0.7f * u * u - 0.4f * v * v + 0.5f * u * v);
      const glm::vec3 slope(-crack.bend * 2.0f * (-1.4f * u + 0.5f * v), -crack.bend * 2.0f * (-0.8f * v + 0.5f * u),
                            1.0f);
      IceVertex vertex;
      vertex.position_m = crack.middle_m + crack.turn * (0.5f * crack.size_m * glm::vec3(u, v, 2.0f * height));
      vertex.normal = glm::normalize(crack.turn * slope);
      vertex.rest_m = {u + 10.0f * crack.seed, v, static_cast<float>(kind)};
      grid.push_back(vertex);
    }
  const std::uint32_t row = cells + 1;
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i)
      for (const std::uint32_t corner : {0u, 1u, row + 1, 0u, row + 1, row})
        inside.push_back(grid[j * row + i + corner]);
}

void append_air(std::vector<IceVertex>& inside, const Box& box, std::uint32_t count, std::uint64_t seed) {
  Random random(seed, 2);
  const glm::vec3 extent = box.max_m - box.min_m;
  const float unit = std::max({extent.x, extent.y, extent.z, 1e-6f});
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto axis = static_cast<glm::length_t>(i % 3), b = (axis + 1) % 3, c = (axis + 2) % 3;
    glm::vec3 middle = 0.5f * (box.min_m + box.max_m), side(0.0f), up(0.0f), normal(0.0f);
    middle[axis] = box.min_m[axis] + extent[axis] * static_cast<float>(random.uniform(0.12, 0.88));
    side[b] = 0.5f * extent[b], up[c] = 0.5f * extent[c], normal[axis] = 1.0f;
    const glm::vec2 shift(random.uniform(), random.uniform());
    const auto corner = [&](float x, float y) {
      const glm::vec2 uv = shift + 0.5f * glm::vec2(x * extent[b], y * extent[c]) / unit;
      inside.push_back({middle + x * side + y * up, normal, {uv.x, uv.y, static_cast<float>(InsideKind::air)}});
    };
    corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, -1), corner(1, 1), corner(-1, 1);
  }
}

}  // namespace septet::ice
