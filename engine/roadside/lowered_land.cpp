#include "engine/roadside/lowered_land.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/roadside/plants.hpp"

namespace septet::roadside {
namespace {

constexpr double clear_m = 0.3;  ///< Clearance of the land below lanes.
constexpr int most_rounds = 60;

using Shares = std::array<double, 4>;

std::array<std::uint64_t, 4> corners_of(const Vec2& low) {
  const auto x = static_cast<std::int64_t>(low.x), y = static_cast<std::int64_t>(low.y);
  return {PlaneCells::key_of(x, y), PlaneCells::key_of(x + 1, y), PlaneCells::key_of(x + 1, y + 1),
          PlaneCells::key_of(x, y + 1)};
}

/// Corners' weights in both triangulations of the square, anticlockwise from the lower left corner.
std::array<Shares, 2> shares_at(const Vec2& share) {
  const double x = share.x, y = share.y;
  const Shares rising = x > y ? Shares{1 - x, x - y, y, 0} : Shares{1 - y, 0, x, y - x};
  const Shares falling = x + y < 1 ? Shares{1 - x - y, x, 0, y} : Shares{0, 1 - y, x + y - 1, 1 - x};
  return {rising, falling};
}

}  // namespace

LoweredLand::LoweredLand(const LaneLevels& lanes, const std::function<double(const Vec2&)>& height_m) {
  std::unordered_map<std::uint64_t, double> heights_m;
  struct Over {
    std::array<std::uint64_t, 4> corners;
    std::array<Shares, 2> shares;
    double most_m;
  };
  std::vector<Over> over;
  const auto excess_m = [&](const Over& at, const Shares& shares) {
    double z = 0.0;
    for (std::size_t k = 0; k < 4; ++k) z += shares[k] * heights_m.at(at.corners[k]);
    return z - at.most_m;
  };
  for (const LaneLevels::Place& place : lanes.places()) {
    const Vec2 cell = place.p / land_cell_m, low = glm::floor(cell);
    const Over at{corners_of(low), shares_at(cell - low), place.most_m - clear_m};
    constexpr std::array<Vec2, 4> steps{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k)
      if (const auto [corner, fresh] = heights_m.try_emplace(at.corners[k], 0.0); fresh)
        corner->second = height_m((low + steps[k]) * land_cell_m);
    if (std::max(excess_m(at, at.shares[0]), excess_m(at, at.shares[1])) > 0.0) over.push_back(at);
  }
  // Each place lowers the corners around it in proportion to their weights, until no place lies under the land or the
  // rounds are used up.
  bool is_done = over.empty();
  for (int round = 0; round < most_rounds && !is_done; ++round) {
    is_done = true;
    for (const Over& at : over)
      for (const Shares& shares : at.shares) {
        const double excess = excess_m(at, shares);
        if (excess <= 0.0) continue;
        is_done = false;
        double squares = 0.0;
        for (const double share : shares) squares += share * share;
        for (std::size_t k = 0; k < 4; ++k) {
          const double by = 1.001 * excess * shares[k] / squares;
          if (by <= 0.0) continue;
          heights_m.at(at.corners[k]) -= by;
          corners_m_[at.corners[k]] += by;
        }
      }
  }
}

double LoweredLand::by_m(const Vec2& p) const {
  if (corners_m_.empty()) return 0.0;
  const Vec2 cell = p / land_cell_m, low = glm::floor(cell), share = cell - low;
  const auto corners = corners_of(low);
  const Shares shares{(1 - share.x) * (1 - share.y), share.x * (1 - share.y), share.x * share.y,
                      (1 - share.x) * share.y};
  double by = 0.0;
  for (std::size_t k = 0; k < 4; ++k)
    if (const auto corner = corners_m_.find(corners[k]); corner != corners_m_.end()) by += shares[k] * corner->second;
  return by;
}

}  // namespace septet::roadside
