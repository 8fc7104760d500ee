#include "engine/traffic/lane_way.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "engine/road/lane_geometry.hpp"

namespace septet::traffic {
namespace {

constexpr double boundless = std::numeric_limits<double>::infinity();
constexpr double least_stretch = 0.05;
/// Tolerance of a uniform lane.
constexpr double uniform_within = 1e-9;
/// Faster than any driver: a higher bound is ignored.
constexpr double unbounded_m2ps2 = 60.0 * 60.0;
/// Time of adapting to a bound's speed, and the hardest braking for a bound that comes as a surprise.
constexpr double adapting_s = 1.0, hardest_adapting_mps2 = 3.0;
constexpr int parts_of_step = 2;

/// A lane at one x.
struct LaneSpot {
  double stretch = 1.0, curvature_per_m = 0.0, limit_mps = 0.0;
  bool level = true;
};

LaneSpot spot_at(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                 const LineTable& lines, double x_m, int lane) {
  const double x = std::min(x_m, corridor.length_m);
  const LineAt at = line_at(network, corridor, lines, x);
  const LaneCentre centre = lane_centre(network, table, at.piece, x, lane);
  const road::Road& road = network.roads[at.piece.road];
  LaneSpot spot;
  spot.stretch = tangent_at(road, at.line, at.s_m, centre.t_m).stretch;
  spot.curvature_per_m = at.line.curvature_per_m / spot.stretch;
  spot.limit_mps = road::speed_limit_mps(network, {at.piece.road, at.piece.side * lane, at.s_m, 0.0});
  spot.level = at.line.curvature_per_m == 0.0 && road.elevation.empty() && road.superelevation.empty();
  return spot;
}

/// Lowers each speed to one from which braking with `ease_off_mps2` leads down to the next; twice round a ring.
void lead_down(const Corridor& corridor, const LaneWay& way, std::vector<double>& squares) {
  const std::size_t count = squares.size();
  if (std::ranges::all_of(squares, [](double square) { return square >= unbounded_m2ps2; })) {
    squares.clear();
    return;
  }
  for (int round = 0; round < (corridor.closed ? 2 : 1); ++round) {
    if (corridor.closed) squares.back() = squares.front() = std::min(squares.back(), squares.front());
    for (std::size_t k = count - 1; k-- > 0;) {
      const double step_m = way.way_m.empty() ? LaneWay::step_m * way.stretch : way.way_m[k + 1] - way.way_m[k];
      squares[k] = std::min(squares[k], squares[k + 1] + 2.0 * ease_off_mps2 * step_m);
    }
  }
}

LaneWay make_lane_way(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                      const LineTable& lines, int lane, bool& straight) {
  LaneWay way;
  const auto steps = static_cast<std::size_t>(std::ceil(corridor.length_m / LaneWay::step_m));
  way.way_m.assign(1, 0.0);
  way.allowed_m2ps2.assign(steps + 1, boundless);
  way.bend_allowed_m2ps2 = way.allowed_m2ps2;
  LaneSpot spot = spot_at(network, corridor, table, lines, 0.0, lane);
  way.stretch = spot.stretch;
  bool uniform = true;
  for (std::size_t k = 0; k < steps; ++k) {
    // Both ends of a step take the bound within it; its length by Simpson's rule.
    const auto bound = [&] {
      const double bend = spot.curvature_per_m != 0.0 ? bend_mps2 / std::abs(spot.curvature_per_m) : boundless;
      const double limit = spot.limit_mps > 0.0 ? std::min(bend, spot.limit_mps * spot.limit_mps) : bend;
      for (const std::size_t end : {k, k + 1}) {
        way.bend_allowed_m2ps2[end] = std::min(way.bend_allowed_m2ps2[end], bend);
        way.allowed_m2ps2[end] = std::min(way.allowed_m2ps2[end], limit);
      }
      uniform = uniform && std::abs(spot.stretch - way.stretch) < uniform_within;
      straight = straight && spot.level;
    };
    const double begin = LaneWay::step_m * static_cast<double>(k);
    const double length = std::min(LaneWay::step_m, corridor.length_m - begin);
    double sum = 0.0;
    for (int part = 0; part < parts_of_step; ++part) {
      const double from = begin + length * part / parts_of_step, step = length / parts_of_step;
      sum += spot.stretch;
      bound();
      spot = spot_at(network, corridor, table, lines, from + 0.5 * step, lane);
      sum += 4.0 * spot.stretch;
      bound();
      spot = spot_at(network, corridor, table, lines, from + step, lane);
      sum += spot.stretch;
    }
    bound();
    // The last step may be cut short by the corridor's end; its knot lies beyond that.
    way.way_m.push_back(way.way_m.back() + sum * LaneWay::step_m / (6.0 * parts_of_step));
  }
  if (uniform) way.way_m.clear();
  lead_down(corridor, way, way.allowed_m2ps2);
  lead_down(corridor, way, way.bend_allowed_m2ps2);
  return way;
}

/// The square at x, and its change by a metre of x.
struct Square {
  double m2ps2 = boundless, by_x = 0.0;
};
Square square_at(std::span<const double> squares, double x_m) {
  if (squares.empty()) return {};
  const double at = x_m * (1.0 / LaneWay::step_m);
  if (!(at > 0.0)) return {squares.front(), 0.0};
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= squares.size()) return {squares.back(), 0.0};
  const double low = std::min(squares[k], unbounded_m2ps2), high = std::min(squares[k + 1], unbounded_m2ps2);
  return {low + (at - static_cast<double>(k)) * (high - low), (high - low) * (1.0 / LaneWay::step_m)};
}

}  // namespace

LineTangent tangent_at(const road::Road& road, const RoadLine& line, double s_m, double t_m) {
  LineTangent tangent;
  tangent.forward = 1.0 - line.curvature_per_m * t_m;
  if (!road.elevation.empty() || !road.superelevation.empty()) {
    const double roll = road::value_at(road.superelevation, s_m);
    const double grade = road::slope_at(road.elevation, s_m);
    const double level = t_m * std::cos(roll);
    tangent.forward = 1.0 - line.curvature_per_m * level;
    tangent.up = grade + level * road::slope_at(road.superelevation, s_m) / std::sqrt(1.0 + grade * grade);
  }
  tangent.stretch =
      std::max(least_stretch, tangent.up == 0.0 ? tangent.forward : std::hypot(tangent.forward, tangent.up));
  return tangent;
}

LaneWays make_lane_ways(const road::RoadNetwork& network, const Corridor& corridor, const LaneTable& table,
                        const LineTable& line) {
  LaneWays ways;
  for (int lane = 0; lane < static_cast<int>(table.open.size()); ++lane)
    ways.lanes.push_back(make_lane_way(network, corridor, table, line, lane, ways.straight));
  return ways;
}

double way_at_m(const LaneWay& way, double x_m) {
  if (way.way_m.empty()) return x_m * way.stretch;
  const double at = x_m * (1.0 / LaneWay::step_m);
  if (!(at > 0.0)) return x_m;
  const auto k = static_cast<std::size_t>(at);
  if (k + 1 >= way.way_m.size())
    return way.way_m.back() + x_m - LaneWay::step_m * static_cast<double>(way.way_m.size() - 1);
  return way.way_m[k] + (at - static_cast<double>(k)) * (way.way_m[k + 1] - way.way_m[k]);
}

double allowed_speed_mps(const LaneWay& way, double x_m, bool is_exempt) {
  return std::sqrt(square_at(is_exempt ? way.bend_allowed_m2ps2 : way.allowed_m2ps2, x_m).m2ps2);
}

double allowed_acceleration_mps2(const LaneWay& way, double x_m, double speed_mps, bool is_exempt) {
  const Square square = square_at(is_exempt ? way.bend_allowed_m2ps2 : way.allowed_m2ps2, x_m);
  if (square.m2ps2 >= unbounded_m2ps2) return boundless;
  const double leads_mps2 = 0.5 * square.by_x / way.stretch;
  return std::max(-hardest_adapting_mps2, leads_mps2 + (std::sqrt(square.m2ps2) - speed_mps) / adapting_s);
}

}  // namespace septet::traffic
