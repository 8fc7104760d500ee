#include "engine/raytrace/headlights.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/light/beam.hpp"

namespace septet::raytrace {
namespace {

template <class Strengths>
float added(const Strengths& s) {
  return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
}

}  // namespace

HeadlightRow::HeadlightRow(std::span<const instant::Headlight> headlights, std::span<const glm::vec3> ways_m,
                           const Vec3& origin_m)
    : count_(headlights.size()) {
  SEPTET_CHECK(ways_m.size() == headlights.size(), "{} headlights, {} ways", headlights.size(), ways_m.size());
  for (std::vector<float>& row : rows_) row.resize((count_ + block - 1) / block * block);
  for (std::size_t n = 0; n < count_; ++n) {
    const glm::vec3 position_m(headlights[n].position_m - origin_m);
    for (int i = 0; i < 3; ++i) {
      rows_[static_cast<std::size_t>(x + i)][n] = position_m[i];
      rows_[static_cast<std::size_t>(way_x + i)][n] = ways_m[n][i];
      rows_[static_cast<std::size_t>(level_x + i)][n] = headlights[n].direction[i];
    }
    rows_[intensity][n] = headlights[n].intensity;
    rows_[main_beam][n] = headlights[n].main_beam;
  }
}

/// Strengths on a surface that faces the headlight.
inline HeadlightRow::Strengths HeadlightRow::strengths(std::size_t first, const glm::vec3& from_m, float time) const {
  std::array<const float*, numbers> row;
  for (std::size_t n = 0; n < row.size(); ++n) row[n] = rows_[n].data() + first;
  Strengths strengths;
  for (std::size_t k = 0; k < block; ++k) {
    const glm::vec3 way(from_m.x - (row[x][k] + row[way_x][k] * time), from_m.y - (row[y][k] + row[way_y][k] * time),
                        from_m.z - (row[z][k] + row[way_z][k] * time));
    const float square = way.x * way.x + way.y * way.y + way.z * way.z;
    const float per_m = 1.0f / std::sqrt(std::max(square, 1e-6f));
    const glm::vec3 level(row[level_x][k], row[level_y][k], row[level_z][k]);
    strengths[k] =
        row[intensity][k] * light::beam_share(level, way * per_m, row[main_beam][k], light::lamp_spread_m2(square));
  }
  return strengths;
}

float HeadlightRow::sum(const glm::vec3& from_m, float time) const {
  float sum = 0.0f;
  for (std::size_t first = 0; first < count_; first += block) sum += added(strengths(first, from_m, time));
  return sum;
}

DrawnHeadlight HeadlightRow::drawn(const glm::vec3& from_m, float time, float uniform, float sum) const {
  float rest = uniform * sum;
  std::size_t first_of_drawn = 0;
  Strengths strengths_there{};  // Fallback where rounding leads past the end: the last block with any strength.
  for (std::size_t first = 0; first < count_; first += block) {
    const Strengths here = strengths(first, from_m, time);
    const float of_block = added(here);
    if (!(of_block > 0.0f)) continue;
    first_of_drawn = first, strengths_there = here;
    if (rest < of_block) break;
    rest -= of_block;
  }
  DrawnHeadlight drawn;
  for (std::size_t k = 0; k < block; ++k) {
    if (!(strengths_there[k] > 0.0f)) continue;
    drawn = {first_of_drawn + k, strengths_there[k]};
    rest -= strengths_there[k];
    if (rest < 0.0f) break;
  }
  return drawn;
}

}  // namespace septet::raytrace
