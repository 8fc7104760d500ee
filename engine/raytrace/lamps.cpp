#include "engine/raytrace/lamps.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"

namespace septet::raytrace {

std::size_t LampWeights::drawn(float uniform) const {
  if (block_count_ == 0) return 0;
  float rest = uniform * sum_;
  std::size_t b = 0;
  while (b + 1 < block_count_ && rest >= blocks_[b]) rest -= blocks_[b++];
  // Rounding may lead past the last lamp of weight, into blocks without any.
  while (b > 0 && !(blocks_[b] > 0.0f)) --b;
  std::size_t chosen = block * b;
  for (std::size_t n = block * b; n < block * (b + 1); ++n) {
    if (!(weights_[n] > 0.0f)) continue;
    chosen = n;
    rest -= weights_[n];
    if (rest < 0.0f) break;
  }
  return chosen;
}

LampRow::LampRow(std::span<const Lamp> lamps) : count_(lamps.size()) {
  SEPTET_CHECK(lamps.size() <= LampWeights::most, "{} lamps", lamps.size());
  const std::size_t size = (lamps.size() + LampWeights::block - 1) / LampWeights::block * LampWeights::block;
  for (std::vector<float>& row : rows_) row.resize(size);
  for (std::size_t n = 0; n < lamps.size(); ++n) {
    const Lamp& lamp = lamps[n];
    for (int i = 0; i < 3; ++i) {
      rows_[static_cast<std::size_t>(x + i)][n] = lamp.middle_m[i];
      rows_[static_cast<std::size_t>(way_x + i)][n] = lamp.way_m[i];
      rows_[static_cast<std::size_t>(axis_x + i)][n] = lamp.axis[i];
    }
    rows_[to_all_sides][n] = 1.0f - std::min(1.0f, glm::length(lamp.axis));
    rows_[radius][n] = lamp.radius_m;
    rows_[power][n] = lamp.power;
  }
}

inline float LampRow::weight(const Rows& row, std::size_t n, const glm::vec3& from_m, const glm::vec3& normal,
                             float in_air, float time) {
  const float to_x = row[x][n] + row[way_x][n] * time - from_m.x, to_y = row[y][n] + row[way_y][n] * time - from_m.y,
              to_z = row[z][n] + row[way_z][n] * time - from_m.z;
  const float radius_m = row[radius][n];
  // Lower bound that keeps a lamp without size or power from being 0 / 0.
  const float square = std::max(std::max(to_x * to_x + to_y * to_y + to_z * to_z, radius_m * radius_m), 1e-12f);
  const float per_m = 1.0f / std::sqrt(square), aside = radius_m * per_m;
  const float facing = (to_x * normal.x + to_y * normal.y + to_z * normal.z) * per_m + aside + in_air;
  const float back = (to_x * row[axis_x][n] + to_y * row[axis_y][n] + to_z * row[axis_z][n]) * per_m;
  const float left = row[to_all_sides][n] + std::max(0.0f, aside - back);
  return row[power][n] / square * std::min(1.0f, std::max(0.0f, facing)) * std::min(1.0f, std::max(0.02f, left));
}

void LampRow::weigh(const glm::vec3& from_m, const glm::vec3& normal, float time, LampWeights& weights) const {
  weights.block_count_ = count_ > 1 ? rows_[power].size() / LampWeights::block : 0;
  weights.sum_ = 0.0f;
  if (count_ == 0) return;
  Rows row;
  for (std::size_t n = 0; n < row.size(); ++n) row[n] = rows_[n].data();
  const float in_air = normal == glm::vec3(0.0f) ? 1.0f : 0.0f;
  if (count_ == 1) {
    weights.weights_[0] = weights.sum_ = weight(row, 0, from_m, normal, in_air, time);
    return;
  }
  for (std::size_t b = 0; b < weights.block_count_; ++b) {
    const std::size_t first = b * LampWeights::block;
    std::array<float, LampWeights::block> here;
    for (std::size_t k = 0; k < LampWeights::block; ++k) here[k] = weight(row, first + k, from_m, normal, in_air, time);
    std::copy(here.begin(), here.end(), weights.weights_.begin() + static_cast<std::ptrdiff_t>(first));
    weights.blocks_[b] = ((here[0] + here[1]) + (here[2] + here[3])) + ((here[4] + here[5]) + (here[6] + here[7]));
    weights.sum_ += weights.blocks_[b];
  }
}

}  // namespace septet::raytrace
