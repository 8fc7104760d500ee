#include "engine/roadside/lane_levels.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"

namespace septet::roadside {
namespace {

/// Half the diagonal between places, and the tolerance for a lane's slope within that.
constexpr double between_m = 1.42, slack_m = 0.3;
constexpr double inside_m = 0.1;         ///< Distance of the first place from a lane's edge.
constexpr double tunnel_clear_m = 60.0;  ///< Distance from a tunnel's mouth within which the hill begins.

/// Adds the places across one station.
void add_row(const RoadShape& roads, road::RoadIndex index, double s_m, std::vector<LaneLevels::Place>& places) {
  const road::Road& road = roads.road(index);
  bool carried = false;
  for (const road::RoadStructure& structure : road.structures) {
    const bool tunnel = structure.kind == road::RoadStructure::Kind::tunnel;
    const double clear_m = tunnel ? tunnel_clear_m : 0.0;
    if (s_m < structure.s_m - clear_m || s_m > structure.s_m + structure.length_m + clear_m) continue;
    if (tunnel) return;
    carried = true;
  }
  const road::LaneSection& section = road::section_at(road, s_m);
  for (int lane = -section.right_count; lane <= section.left_count; ++lane) {
    if (lane == 0) continue;
    const road::LaneType type = section.lane(lane).type;
    if (!road::is_drivable(type) && !is_walked(type)) continue;
    const road::LaneBorders borders = road::lane_borders(road, section, lane, s_m);
    const double width = borders.width_m();
    if (width < 2.0 * inside_m) continue;
    const double low = std::min(borders.inner_t_m, borders.outer_t_m) + inside_m, span = width - 2.0 * inside_m;
    const int count = std::max(1, static_cast<int>(std::ceil(span / LaneLevels::across_step_m)));
    for (int k = 0; k <= count; ++k) {
      const Vec3 at = road::evaluate(roads.network(), {index, s_m, low + span * k / count}).position_m;
      places.push_back({Vec2(at), carried ? at.z - LaneLevels::deck_room_m : at.z, carried});
    }
  }
}

}  // namespace

bool is_walked(road::LaneType type) { return type == road::LaneType::sidewalk || type == road::LaneType::biking; }

LaneLevels::LaneLevels(const RoadShape& roads) {
  for (road::RoadIndex index = 0; index < roads.network().roads.size(); ++index) {
    const double length_m = roads.road(index).length_m;
    const int count = std::max(1, static_cast<int>(std::ceil(length_m / along_step_m)));
    for (int i = 0; i <= count; ++i) add_row(roads, index, length_m * i / count, places_);
  }
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(places_.size());
  for (std::uint32_t i = 0; i < places_.size(); ++i) order.emplace_back(cells.key_at(places_[i].p), i);
  std::sort(order.begin(), order.end());
  std::vector<Place> sorted;
  sorted.reserve(places_.size());
  for (const auto& [key, i] : order) {
    Cell& cell = by_cell_[key];
    if (cell.end == 0) cell.first = static_cast<std::uint32_t>(sorted.size());
    sorted.push_back(places_[i]);
    cell.end = static_cast<std::uint32_t>(sorted.size());
    cell.least_m = std::min(cell.least_m, places_[i].most_m);
  }
  places_ = std::move(sorted);
  for (const auto& entry : by_cell_) {
    const Cell& cell = entry.second;
    const Vec2& p = places_[cell.first].p;
    cells.for_each(p - reach_m - cells.cell_m, p + reach_m + cells.cell_m, [&](std::uint64_t near) {
      double& least = least_near_.try_emplace(near, 1e300).first->second;
      least = std::min(least, cell.least_m);
    });
  }
}

double LaneLevels::least_near_m(const Vec2& p) const {
  const auto found = least_near_.find(cells.key_at(p));
  return found == least_near_.end() ? 1e300 : found->second;
}

double LaneLevels::limited_m(const Vec2& p, double z_m) const {
  if (z_m <= least_near_m(p) + slack_m) return z_m;
  for_each(p - reach_m, p + reach_m, [&](const Place& place) {
    if (z_m <= place.most_m + slack_m) return;
    const double beyond_m = std::max(0.0, glm::distance(p, place.p) - between_m);
    if (place.carried && beyond_m > 0.0) return;
    z_m = std::min(z_m, place.most_m + slack_m + steepest * beyond_m);
  });
  return z_m;
}

}  // namespace septet::roadside
