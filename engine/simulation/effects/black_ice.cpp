#include "engine/simulation/effects/black_ice.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/lane_geometry.hpp"

namespace septet::simulation {

std::optional<IceEdges> edges_at(const road::RoadNetwork& roads, const BlackIce& ice, double s_m) {
  const double along_m = s_m - ice.s_m;
  if (!(along_m >= 0.0 && along_m <= ice.length_m) || ice.road >= roads.roads.size()) return std::nullopt;
  const road::Road& road = roads.roads[ice.road];
  const road::LaneSection& section = road::section_at(road, s_m);
  if (ice.lane == 0 || !section.has_lane(ice.lane)) return std::nullopt;
  const road::LaneBorders lane = road::lane_borders(road, section, ice.lane, s_m);
  // Length of the rounded ends; no edge is straight.
  constexpr double end_m = 3.0;
  const double from_end = std::min({along_m, ice.length_m - along_m, end_m}) / end_m;
  const double width = std::sqrt(std::max(0.0, 1.0 - (1.0 - from_end) * (1.0 - from_end)));
  const double half = 0.5 * lane.width_m(), middle = lane.centre_t_m();
  const double left = 0.86 + 0.09 * std::sin(0.9 * along_m) + 0.05 * std::sin(2.3 * along_m + 1.0),
               right = 0.86 + 0.09 * std::sin(0.7 * along_m + 2.0) + 0.05 * std::sin(1.9 * along_m);
  return IceEdges{middle - half * width * right, middle + half * width * left};
}

bool is_iced(const road::RoadNetwork& roads, const BlackIce& ice, double thawed_kh, const road::RoadPosition& place) {
  if (place.road != ice.road || ice::left_m(ice.thickness_m, thawed_kh) == 0.0) return false;
  const auto edges = edges_at(roads, ice, place.s_m);
  return edges && place.t_m > edges->right_t_m && place.t_m < edges->left_t_m;
}

ice::Sheet sheet_of(const road::RoadNetwork& roads, const BlackIce& ice) {
  constexpr double step_m = 1.0;
  ice::Sheet sheet;
  sheet.thickness_m = ice.thickness_m;
  const int steps = std::clamp(static_cast<int>(std::ceil(ice.length_m / step_m)), 1, 255);
  for (int i = 0; i <= steps; ++i) {
    const double s_m = i == steps ? ice.s_m + ice.length_m : ice.s_m + ice.length_m * i / steps;
    const auto edges = edges_at(roads, ice, std::min(s_m, ice.s_m + ice.length_m));
    if (!edges) continue;
    sheet.left_m.push_back(road::evaluate(roads, {ice.road, s_m, edges->left_t_m}).position_m);
    sheet.right_m.push_back(road::evaluate(roads, {ice.road, s_m, edges->right_t_m}).position_m);
  }
  return sheet;
}

}  // namespace septet::simulation
