#include "engine/raytrace/smoke.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/light/puff.hpp"

namespace septet::raytrace {
namespace {

constexpr float reach_deviations = 4.0f;

/// False also for positions beyond a float.
bool counts(const instant::SmokePuff& puff) {
  return puff.extinction_area_m2 > 0.0f && puff.radius_m > 0.0f &&
         std::abs(puff.position_m.x) + std::abs(puff.position_m.y) + std::abs(puff.position_m.z) +
                 double(puff.radius_m) + double(puff.extinction_area_m2) <
             1e7;
}

}  // namespace

Smoke::Smoke(std::span<const instant::SmokePuff> puffs, const Vec3& origin_m) {
  glm::vec3 low(std::numeric_limits<float>::infinity()), high = -low;
  float smallest_m = low.x;
  for (const instant::SmokePuff& puff : puffs) {
    if (!counts(puff)) continue;
    const glm::vec3 middle(puff.position_m - origin_m), reach(reach_deviations * puff.radius_m);
    low = glm::min(low, middle - reach), high = glm::max(high, middle + reach);
    smallest_m = std::min(smallest_m, puff.radius_m);
  }
  if (!(low.x <= high.x)) return;
  const glm::dvec3 size(high - low);
  cell_m_ = std::max({0.5f * smallest_m, 0.02f,
                      static_cast<float>(std::cbrt(size.x * size.y * size.z / static_cast<double>(most_cells)))});
  const auto along = [&](int axis) { return std::ceil(size[axis] / double(cell_m_)) + 1.0; };
  // Long and thin boxes have a row more of cells on each side.
  while (along(0) * along(1) * along(2) > static_cast<double>(most_cells)) cell_m_ *= 1.1f;
  for (int axis = 0; axis < 3; ++axis) count_[static_cast<std::size_t>(axis)] = static_cast<int>(along(axis));
  corner_m_ = low;
  std::size_t blocks = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    block_count_[axis] = (count_[axis] + block_side - 1) / block_side;
    blocks *= static_cast<std::size_t>(block_count_[axis]);
  }
  blocks_.assign(blocks, no_block);
  for (const instant::SmokePuff& puff : puffs)
    if (counts(puff)) add(puff, glm::vec3(puff.position_m - origin_m));
  for (Cell& cell : cells_)
    if (cell.extinction_per_m > 0.0f) cell.albedo /= cell.extinction_per_m, cell.flames /= cell.extinction_per_m;
}

void Smoke::add(const instant::SmokePuff& puff, const glm::vec3& middle_m) {
  const float reach_m = reach_deviations * puff.radius_m;
  std::array<int, 3> first{}, last{};
  std::array<std::vector<float>, 3> weight;
  float sum = 1.0f;
  // Product of its three sections, which a Gaussian is.
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const float at = middle_m[static_cast<int>(axis)] - corner_m_[static_cast<int>(axis)];
    first[axis] = std::clamp(static_cast<int>((at - reach_m) / cell_m_), 0, count_[axis] - 1);
    last[axis] = std::clamp(static_cast<int>((at + reach_m) / cell_m_), first[axis], count_[axis] - 1);
    float total = 0.0f;
    for (int n = first[axis]; n <= last[axis]; ++n) {
      const float away = ((static_cast<float>(n) + 0.5f) * cell_m_ - at) / puff.radius_m;
      weight[axis].push_back(light::puff_density(away * away));
      total += weight[axis].back();
    }
    sum *= total;
  }
  const float per_m = puff.extinction_area_m2 / (sum * cell_m_ * cell_m_ * cell_m_);
  for (int z = first[2]; z <= last[2]; ++z)
    for (int y = first[1]; y <= last[1]; ++y) {
      const float row =
          per_m * weight[2][static_cast<std::size_t>(z - first[2])] * weight[1][static_cast<std::size_t>(y - first[1])];
      int x = first[0];
      for (const float each : weight[0]) {
        std::uint32_t& block = blocks_[block_of(x, y, z)];
        if (block == no_block) {
          block = static_cast<std::uint32_t>(cells_.size() / block_cells);
          cells_.resize(cells_.size() + block_cells);
        }
        Cell& cell = cells_[block * block_cells + within_block(x++, y, z)];
        const float extinction = row * each;
        cell.extinction_per_m += extinction;
        cell.albedo += extinction * puff.albedo;
        cell.flames += extinction * puff.glow * puff.glow;
      }
    }
}

/// Calls visit(cell, from_m, to_m) for each cell in the ray's order, until it returns false.
template <typename Visit>
void Smoke::march(const Ray& ray, const Visit& visit) const {
  if (blocks_.empty()) return;
  const Cell clear{};
  constexpr float far = std::numeric_limits<float>::infinity();
  float from_m = ray.from_m, to_m = ray.to_m;
  glm::vec3 per_cell_m(far);
  for (int axis = 0; axis < 3; ++axis) {
    const float size = static_cast<float>(count_[static_cast<std::size_t>(axis)]) * cell_m_;
    const float begin = corner_m_[axis] - ray.origin_m[axis], way = ray.direction[axis];
    if (std::abs(way) < 1e-9f) {
      if (begin > 0.0f || begin + size < 0.0f) return;
      continue;
    }
    const float a = begin / way, b = (begin + size) / way;
    from_m = std::max(from_m, std::min(a, b)), to_m = std::min(to_m, std::max(a, b));
    per_cell_m[axis] = cell_m_ / std::abs(way);
  }
  if (!(from_m < to_m)) return;
  const glm::vec3 at = (ray.origin_m + ray.direction * from_m - corner_m_) / cell_m_;
  std::array<int, 3> cell{}, step{};
  glm::vec3 next_m(far);
  for (int axis = 0; axis < 3; ++axis) {
    const auto n = static_cast<std::size_t>(axis);
    cell[n] = std::clamp(static_cast<int>(std::floor(at[axis])), 0, count_[n] - 1);
    step[n] = ray.direction[axis] > 0.0f ? 1 : -1;
    if (per_cell_m[axis] == far) continue;
    const float ahead =
        step[n] > 0 ? static_cast<float>(cell[n] + 1) - at[axis] : at[axis] - static_cast<float>(cell[n]);
    next_m[axis] = from_m + std::max(0.0f, ahead) * per_cell_m[axis];
  }
  while (from_m < to_m) {
    const int axis = next_m.x < next_m.y ? (next_m.x < next_m.z ? 0 : 2) : (next_m.y < next_m.z ? 1 : 2);
    const auto n = static_cast<std::size_t>(axis);
    const float end_m = std::min(next_m[axis], to_m);
    const std::uint32_t block = blocks_[block_of(cell[0], cell[1], cell[2])];
    const Cell& here =
        block == no_block ? clear : cells_[block * block_cells + within_block(cell[0], cell[1], cell[2])];
    if (end_m > from_m && !visit(here, from_m, end_m)) return;
    from_m = std::max(from_m, end_m);
    cell[n] += step[n];
    if (cell[n] < 0 || cell[n] >= count_[n]) return;
    next_m[axis] += per_cell_m[axis];
  }
}

float Smoke::optical_depth(const Ray& ray) const {
  float depth = 0.0f;
  march(ray, [&](const Cell& cell, float from_m, float to_m) {
    depth += cell.extinction_per_m * (to_m - from_m);
    return depth < 30.0f;  // No measurable light is left.
  });
  return depth;
}

SmokeWalk Smoke::walk(const Ray& ray, float depth_to_scatter) const {
  SmokeWalk walk;
  float depth = 0.0f, left = 1.0f, flames = 0.0f;
  march(ray, [&](const Cell& cell, float from_m, float to_m) {
    const float here = cell.extinction_per_m * (to_m - from_m);
    if (here <= 0.0f) return true;
    const float left_behind = left * std::exp(-here);
    flames += (left - left_behind) * cell.flames;
    left = left_behind;
    if (!walk.scatters && depth + here > depth_to_scatter) {
      walk.scatters = true;
      walk.distance_m = from_m + (depth_to_scatter - depth) / cell.extinction_per_m;
      walk.albedo = cell.albedo;
    }
    depth += here;
    return !walk.scatters || left > 1e-4f;
  });
  walk.emitted = flames * instant::flame_radiance;
  return walk;
}

}  // namespace septet::raytrace
