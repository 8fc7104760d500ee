#include "engine/roadside/ground_beside.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/plants.hpp"

namespace septet::roadside {
namespace {

constexpr double road_reach_m = 60.0;
/// Zones of the strip beside the road, as scenery/world/verges.cpp draws it: from the edge into the land, over the
/// land's grid, and under it.
constexpr double bank_until_m = 9.5, strip_until_m = 20.0, grid_from_m = 38.0, strip_lift_m = 0.35;
constexpr double uneven_from_m = 2.0, uneven_until_m = 6.0;

/// Bilinear height between the corners of the drawn land's finest grid; keeps those of the last cell.
class DrawnLand {
 public:
  explicit DrawnLand(const Terrain& terrain) : terrain_(terrain) {}

  double height_m(const Vec2& p) {
    const Vec2 cell = p / land_cell_m, low = glm::floor(cell), share = cell - low;
    if (!has_cell_ || low != low_) {
      const auto corner = [&](double x, double y) { return terrain_.height_m((low + Vec2(x, y)) * land_cell_m); };
      corners_m_ = {corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)};
      low_ = low;
      has_cell_ = true;
    }
    return std::lerp(std::lerp(corners_m_[0], corners_m_[1], share.x), std::lerp(corners_m_[2], corners_m_[3], share.x),
                     share.y);
  }

 private:
  const Terrain& terrain_;
  Vec2 low_{0.0};
  std::array<double, 4> corners_m_{};
  bool has_cell_ = false;
};

/// Edge of the nearest road beside a point.
struct RoadEdge {
  double outside_m = std::numeric_limits<double>::infinity(), z_m = 0.0;
};

RoadEdge edge_near(const road::RoadNetwork& roads, const Nearest& near, const Vec2& p, const road::RoadPosition* hint,
                   std::optional<double> level_m) {
  const auto found = road::locate(roads, p, hint, road_reach_m, level_m);
  if (found) {
    const road::RoadPosition& at = found->position;
    const road::Road& road = roads.roads[at.road];
    // Roads run on beyond a loose end, which the terrain has.
    if (at.s_m > 0.0 && at.s_m < road.length_m) {
      const road::RoadExtent extent = road::road_extent(road, at.s_m);
      const double t_m = std::clamp(at.t_m, extent.right_t_m, extent.left_t_m);
      return {found->lanes.outside_m, road::evaluate(roads, {at.road, at.s_m, t_m}).position_m.z};
    }
  }
  if (near.found) return {near.outside_m, near.edge_z_m};
  return {};
}

bool is_in_tunnel(const road::RoadNetwork& roads, const Nearest& near) {
  return near.found &&
         std::ranges::any_of(roads.roads[near.road].structures, [&](const road::RoadStructure& structure) {
           return structure.kind == road::RoadStructure::Kind::tunnel && near.s_m > structure.s_m &&
                  near.s_m < structure.s_m + structure.length_m;
         });
}

double height_m(const road::RoadNetwork& roads, const Terrain& terrain, DrawnLand& drawn, const Vec2& p,
                const road::RoadPosition* hint, std::optional<double> level_m) {
  const Nearest near = terrain.nearest(p);
  const RoadEdge edge = edge_near(roads, near, p, hint, level_m);
  if (edge.outside_m <= paved_edge_m) return edge.z_m;
  const double uneven_m = smooth_step(uneven_from_m, uneven_until_m, edge.outside_m) * unevenness_m(p);
  if (edge.outside_m >= grid_from_m) return drawn.height_m(p) + uneven_m;
  // No vehicle gets inside a hill: the tunnel's floor goes on as far as its walls let any vehicle come.
  if (is_in_tunnel(roads, near)) return edge.z_m;
  double land_m = terrain.height_m(p, near) + strip_lift_m;
  if (edge.outside_m > strip_until_m)
    land_m = std::lerp(land_m, drawn.height_m(p), (edge.outside_m - strip_until_m) / (grid_from_m - strip_until_m));
  const double bank_m = std::lerp(edge.z_m, land_m, smooth_step(paved_edge_m, bank_until_m, edge.outside_m));
  return terrain.lanes().limited_m(p, bank_m) + uneven_m;
}

/// Wave of an uneven ground, for one band of spatial frequencies and one direction.
struct Wave {
  Vec2 per_m{0.0};  ///< Wave vector, radians a metre.
  double amplitude_m = 0.0, phase_rad = 0.0;
};

std::array<Wave, 16> waves_of(double density_m3) {
  constexpr double lowest_pm = 0.05, highest_pm = 1.0, reference_pm = 0.1, golden_rad = 2.399963229728653;
  std::array<Wave, 16> waves;
  const double ratio = std::pow(highest_pm / lowest_pm, 1.0 / static_cast<double>(waves.size()));
  double from_pm = lowest_pm;
  for (std::size_t i = 0; i < waves.size(); ++i, from_pm *= ratio) {
    // Density falls with the square of the frequency; its integral over the band is half the amplitude squared.
    const double variance_m2 = density_m3 * reference_pm * reference_pm * (1.0 / from_pm - 1.0 / (from_pm * ratio));
    const double way_rad = golden_rad * static_cast<double>(i),
                 number = 2.0 * std::numbers::pi * from_pm * std::sqrt(ratio);
    waves[i] = {number * Vec2(std::cos(way_rad), std::sin(way_rad)), std::sqrt(2.0 * variance_m2),
                1.7 * static_cast<double>(i * i)};
  }
  return waves;
}

}  // namespace

const GroundCover& meadow() {
#define SEPTET_ENTRY(name, ...) static constexpr GroundCover name __VA_ARGS__;
#include "engine/roadside/ground_beside.toml.inc"
  return meadow;
}

double unevenness_m(const Vec2& p) {
  static const std::array<Wave, 16> waves = waves_of(meadow().roughness_m3);
  double sum_m = 0.0;
  for (const Wave& wave : waves) sum_m += wave.amplitude_m * std::cos(glm::dot(wave.per_m, p) + wave.phase_rad);
  return sum_m;
}

GroundBeside ground_beside(const road::RoadNetwork& roads, const Terrain& terrain, const Vec2& p,
                           const road::RoadPosition* hint, std::optional<double> level_m) {
  constexpr double apart_m = 0.3;
  DrawnLand drawn(terrain);
  GroundBeside ground;
  ground.height_m = height_m(roads, terrain, drawn, p, hint, level_m);
  const double along_x =
                   (height_m(roads, terrain, drawn, p + Vec2(apart_m, 0.0), hint, level_m) - ground.height_m) / apart_m,
               along_y =
                   (height_m(roads, terrain, drawn, p + Vec2(0.0, apart_m), hint, level_m) - ground.height_m) / apart_m;
  ground.normal = glm::normalize(Vec3(-along_x, -along_y, 1.0));
  return ground;
}

}  // namespace septet::roadside
