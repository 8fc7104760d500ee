#include "engine/traffic/lane_table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "engine/road/lane_geometry.hpp"

namespace septet::traffic {
namespace {

constexpr double narrowest_m = 2.6;
constexpr double step_m = 10.0;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_open(const road::RoadNetwork& network, const Corridor& corridor, double x_m, int lane) {
  const auto at = position_at(corridor, x_m, lane);
  const road::Road& road = network.roads[at.road];
  const auto& section = road::section_at(road, at.s_m);
  if (!section.has_lane(at.lane) || !road::is_drivable(section.lane(at.lane).type)) return false;
  return road::lane_borders(road, section, at.lane, at.s_m).width_m() >= narrowest_m;
}

std::vector<OpenStretch> stretches(const road::RoadNetwork& network, const Corridor& corridor,
                                   int lane) {
  std::vector<OpenStretch> found;
  const auto steps = static_cast<int>(std::ceil(corridor.length_m / step_m));
  for (int i = 0; i < steps; ++i) {
    // The middle of each step stands for it.
    const double x = std::min((i + 0.5) * step_m, corridor.length_m);
    if (!is_open(network, corridor, x, lane)) continue;
    const double begin = i * step_m, end = std::min((i + 1) * step_m, corridor.length_m);
    if (!found.empty() && found.back().end_m == begin)
      found.back().end_m = end;
    else
      found.push_back({begin, end});
  }
  if (!found.empty() && found.back().end_m == corridor.length_m) {
    // On a ring that is closed here the lane goes on at the beginning.
    const bool goes_on = !corridor.closed || found.front().begin_m == 0.0;
    if (goes_on) found.back().end_m = infinity;
  }
  if (!found.empty() && found.front().begin_m == 0.0) found.front().begin_m = -infinity;
  return found;
}

double length_m(const std::vector<OpenStretch>& open, double most_m) {
  double sum = 0.0;
  for (const auto& stretch : open)
    sum += std::min(stretch.end_m, most_m) - std::max(stretch.begin_m, 0.0);
  return sum;
}

}  // namespace

LaneTable make_lane_table(const road::RoadNetwork& network, const Corridor& corridor) {
  int most = 0;
  for (const auto& piece : corridor.pieces) {
    for (const auto& section : network.roads[piece.road].sections) {
      most = std::max(most, piece.side > 0 ? section.left_count : section.right_count);
    }
  }
  LaneTable table;
  table.open.resize(static_cast<std::size_t>(most) + 2);
  table.lowest = 0;
  for (int lane = 1; lane <= most; ++lane) {
    auto& open = table.open[static_cast<std::size_t>(lane)];
    open = stretches(network, corridor, lane);
    if (open.empty()) continue;
    table.highest = lane;
    if (table.lowest == 0 && length_m(open, corridor.length_m) > 0.5 * corridor.length_m)
      table.lowest = lane;
  }
  table.lowest = std::max(table.lowest, 1);
  const auto middle = position_at(corridor, 0.5 * corridor.length_m, table.lowest);
  const double width = road::lane_width_m(network, middle.road, middle.lane, middle.s_m);
  if (width > narrowest_m) table.lane_width_m = width;
  return table;
}

double lane_end_m(const LaneTable& table, int lane, double x_m) {
  if (lane >= 1 && lane < static_cast<int>(table.open.size())) {
    for (const auto& stretch : table.open[static_cast<std::size_t>(lane)]) {
      if (x_m < stretch.end_m) return x_m >= stretch.begin_m ? stretch.end_m : -infinity;
    }
  }
  return -infinity;
}

}  // namespace septet::traffic
