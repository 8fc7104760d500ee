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
/// Limit of the distance by which a corner of the lane's middle is cut.
constexpr double largest_cut_m = 0.1;
constexpr double infinity = std::numeric_limits<double>::infinity();

bool is_open(const road::RoadNetwork& network, const Corridor& corridor, double x_m, int lane) {
  const auto at = position_at(corridor, x_m, lane);
  const road::Road& road = network.roads[at.road];
  const auto& section = road::section_at(road, at.s_m);
  if (!section.has_lane(at.lane) || !road::is_drivable(section.lane(at.lane).type)) return false;
  return road::lane_borders(road, section, at.lane, at.s_m).width_m() >= narrowest_m;
}

std::vector<OpenStretch> stretches(const road::RoadNetwork& network, const Corridor& corridor, int lane) {
  std::vector<OpenStretch> found;
  const auto steps = static_cast<int>(std::ceil(corridor.length_m / step_m));
  for (int i = 0; i < steps; ++i) {
    // The middle of each step represents it.
    const double x = std::min((i + 0.5) * step_m, corridor.length_m);
    if (!is_open(network, corridor, x, lane)) continue;
    const double begin = i * step_m, end = std::min((i + 1) * step_m, corridor.length_m);
    if (!found.empty() && found.back().end_m == begin)
      found.back().end_m = end;
    else
      found.push_back({begin, end});
  }
  if (!found.empty() && found.back().end_m == corridor.length_m) {
    // On a ring that is closed here the lane continues at the beginning.
    const bool goes_on = !corridor.closed || found.front().begin_m == 0.0;
    if (goes_on) found.back().end_m = infinity;
  }
  if (!found.empty() && found.front().begin_m == 0.0) found.front().begin_m = -infinity;
  return found;
}

LaneCentre exact_centre(const road::RoadNetwork& network, const CorridorPiece& piece, double x_m, int lane) {
  const road::Road& road = network.roads[piece.road];
  const double along = std::clamp(x_m - piece.x_m, 0.0, piece.length_m);
  const double s = piece.along_s ? along : piece.length_m - along;
  const auto& section = road::section_at(road, s);
  const int outermost = piece.side > 0 ? section.left_count : section.right_count;
  const auto borders = road::lane_borders(road, section, piece.side * std::min(lane, outermost), s);
  return {borders.centre_t_m(), borders.centre_slope(), 0.0};
}

LaneCentre between(const CentreLine::Knot& from, const CentreLine::Knot& to, double u) {
  constexpr double h = LaneTable::knot_step_m;
  const double rise = to.t_m - from.t_m, m0 = h * from.slope_by_x, m1 = h * to.slope_by_x;
  const double quadratic = 3.0 * rise - 2.0 * m0 - m1, cubic = m0 + m1 - 2.0 * rise;
  return {from.t_m + u * (m0 + u * (quadratic + u * cubic)), (m0 + u * (2.0 * quadratic + u * 3.0 * cubic)) * (1.0 / h),
          (2.0 * quadratic + u * 6.0 * cubic) * (1.0 / (h * h))};
}

CentreLine centre_line(const road::RoadNetwork& network, const Corridor& corridor, int lane) {
  constexpr double h = LaneTable::knot_step_m;
  CentreLine line;
  line.knots.resize(static_cast<std::size_t>(corridor.length_m / h) + 1);
  const auto at = [&](double x) { return exact_centre(network, piece_at(corridor, x), x, lane); };
  const auto sign = [&](double x) { return piece_at(corridor, x).along_s ? 1.0 : -1.0; };
  for (std::size_t k = 0; k < line.knots.size(); ++k) {
    const double x = h * static_cast<double>(k);
    const LaneCentre centre = at(x);
    line.knots[k] = {centre.t_m, sign(x) * centre.slope, false};
  }
  for (std::size_t k = 0; k + 1 < line.knots.size(); ++k) {
    const double x = h * static_cast<double>(k);
    bool smooth = &piece_at(corridor, x) == &piece_at(corridor, x + h);
    for (const double u : {0.15, 0.4, 0.6, 0.85}) {
      const LaneCentre guess = between(line.knots[k], line.knots[k + 1], u);
      smooth = smooth && std::abs(guess.t_m - at(x + u * h).t_m) < largest_cut_m;
    }
    line.knots[k].smooth = smooth;
  }
  return line;
}

double length_m(const std::vector<OpenStretch>& open, double most_m) {
  double sum = 0.0;
  for (const auto& stretch : open) sum += std::min(stretch.end_m, most_m) - std::max(stretch.begin_m, 0.0);
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
    if (table.lowest == 0 && length_m(open, corridor.length_m) > 0.5 * corridor.length_m) table.lowest = lane;
  }
  table.lowest = std::max(table.lowest, 1);
  const auto middle = position_at(corridor, 0.5 * corridor.length_m, table.lowest);
  const double width = road::lane_width_m(network, middle.road, middle.lane, middle.s_m);
  if (width > narrowest_m) table.lane_width_m = width;
  for (int lane = 0; lane < static_cast<int>(table.open.size()); ++lane)
    table.centres.push_back(centre_line(network, corridor, lane));
  return table;
}

LaneCentre lane_centre(const road::RoadNetwork& network, const LaneTable& table, const CorridorPiece& piece, double x_m,
                       int lane) {
  const auto& knots = table.centres[static_cast<std::size_t>(lane)].knots;
  const double at = x_m * (1.0 / LaneTable::knot_step_m);
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= knots.size() || !knots[k].smooth) return exact_centre(network, piece, x_m, lane);
  const LaneCentre centre = between(knots[k], knots[k + 1], at - static_cast<double>(k));
  return {centre.t_m, piece.along_s ? centre.slope : -centre.slope, centre.slope_by_s};
}

LaneCentre lane_centre_along(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                             double x_m, int lane) {
  const double x = std::clamp(wrap_x(corridor, x_m), 0.0, corridor.length_m);
  const CorridorPiece& piece = piece_at(corridor, x);
  const LaneCentre centre = lane_centre(network, table, piece, x, lane);
  // Against s both t and s are reversed.
  return {piece.along_s ? centre.t_m : -centre.t_m, centre.slope, centre.slope_by_s};
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
