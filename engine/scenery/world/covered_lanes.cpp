#include "engine/scenery/world/covered_lanes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/road/decks.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"

namespace septet::scenery {
namespace {

/// Weights of a triangle's corners at p, seen from above; all 0 outside of it.
Vec3 shares_in(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& p) {
  const Vec2 u = b - a, v = c - a, w = p - a;
  const double area = u.x * v.y - u.y * v.x;
  if (std::abs(area) < 1e-9) return Vec3(0.0);
  const double s = (w.x * v.y - w.y * v.x) / area, t = (u.x * w.y - u.y * w.x) / area;
  if (s < 0.0 || t < 0.0 || s + t > 1.0) return Vec3(0.0);
  return {1.0 - s - t, s, t};
}

/// Quad between two rows and the box around it.
struct Quad {
  std::array<Vec3*, 4> corners;
  std::size_t row, column;
  Vec3 low{1e300}, high{-1e300};

  Quad(std::vector<std::vector<Vec3>>& rows, std::size_t i, std::size_t k)
      : corners{&rows[i - 1][k], &rows[i][k], &rows[i][k + 1], &rows[i - 1][k + 1]}, row(i), column(k) {
    for (const Vec3* corner : corners) {
      low = glm::min(low, *corner);
      high = glm::max(high, *corner);
    }
  }
  std::array<Vec3*, 3> without(std::size_t corner) const {
    return {corners[(corner + 1) % 4], corners[(corner + 2) % 4], corners[(corner + 3) % 4]};
  }
};

/// Adds the place of a lane where one of the quad's triangles lies over it.
void add_covered(const Quad& quad, const Vec2& p, double most_m, std::vector<Covered>& covered) {
  constexpr double noticed_m = 0.01;
  if (most_m + noticed_m >= quad.high.z || p.x < quad.low.x || p.y < quad.low.y || p.x > quad.high.x ||
      p.y > quad.high.y)
    return;
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const std::array<Vec3*, 3> corners = quad.without(left_out);
    const Vec3 shares = shares_in(Vec2(*corners[0]), Vec2(*corners[1]), Vec2(*corners[2]), p);
    const Covered at{corners, shares, most_m, quad.row, quad.column};
    if (shares != Vec3(0.0) && at.excess_m() > noticed_m) covered.push_back(at);
  }
}

/// Adds lanes below a quad that lie between their places: its triangles are tested on a grid, of 0.9 m where they are not
/// large.
void add_between_places(const WorldContext& world, const RoadTile& tile, double s, const Quad& quad,
                        std::vector<Covered>& covered) {
  constexpr double apart_m = 0.9;
  constexpr int most_parts = 5;
  const road::RoadNetwork& network = world.roads.network();
  const auto test = [&](const Vec2& p) {
    for (const road::Location& location : road::roads_holding(network, p)) {
      const bool own = location.position.road == tile.road && std::abs(location.position.s_m - s) < over_itself_m;
      const double most_m = road::evaluate(network, location.position).position_m.z;
      if (!own && most_m + road::least_rise_m > quad.high.z) add_covered(quad, p, most_m, covered);
    }
  };
  const int parts =
      std::clamp(static_cast<int>(std::ceil(glm::length(Vec2(quad.high - quad.low)) / apart_m)), 1, most_parts);
  for (std::size_t left_out = 0; left_out < 4; ++left_out) {
    const auto [a, b, c] = quad.without(left_out);
    // Middles of those of its parts that stand as it does.
    for (int i = 0; i < parts; ++i)
      for (int j = 0; i + j < parts; ++j) {
        const double u = (i + 1.0 / 3.0) / parts, v = (j + 1.0 / 3.0) / parts;
        test(Vec2(*a) * (1.0 - u - v) + Vec2(*b) * u + Vec2(*c) * v);
      }
  }
}

}  // namespace

std::vector<Covered> covered_lanes(const WorldContext& world, const RoadTile& tile, std::span<const double> along,
                                   std::vector<std::vector<Vec3>>& rows, bool among_roads) {
  using roadside::LaneLevels;
  const LaneLevels& lanes = world.terrain.lanes();
  std::vector<Covered> covered;
  for (std::size_t i = 1; i < rows.size(); ++i)
    for (std::size_t k = 0; k + 1 < rows[i].size(); ++k) {
      const Quad quad(rows, i, k);
      bool is_near_lower = false;
      const Vec2 beside_m(LaneLevels::across_step_m);
      lanes.for_each(Vec2(quad.low) - beside_m, Vec2(quad.high) + beside_m, [&](const LaneLevels::Place& place) {
        is_near_lower = is_near_lower || place.most_m < quad.high.z;
        add_covered(quad, place.p, place.most_m, covered);
      });
      if (is_near_lower && among_roads) add_between_places(world, tile, along[i], quad, covered);
    }
  return covered;
}

std::set<std::pair<std::size_t, std::size_t>> lower_below_lanes(const std::vector<Covered>& covered) {
  constexpr int most_rounds = 24;
  constexpr double clear_m = 0.03;
  for (int round = 0; round < most_rounds; ++round)
    for (const Covered& at : covered) {
      const double excess = at.excess_m() + clear_m;
      if (excess <= 0.0) continue;
      const double squares = glm::dot(at.shares, at.shares);
      for (int k = 0; k < 3; ++k) at.corners[static_cast<std::size_t>(k)]->z -= excess * at.shares[k] / squares;
    }
  std::set<std::pair<std::size_t, std::size_t>> left_out;
  for (const Covered& at : covered)
    if (at.excess_m() > 0.0) left_out.emplace(at.row, at.column);
  return left_out;
}

}  // namespace septet::scenery
