#include "engine/road/body_lanes.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/lane_geometry.hpp"

namespace septet::road {

LaneRange drivable_lanes_under(const RoadNetwork& network, const RoadPosition& origin, const BodyOutline& body) {
  const double turned_rad = body.heading_rad - evaluate(network, origin).heading_rad;
  const double to_front_m = std::sin(turned_rad) * body.front_m, to_rear_m = -std::sin(turned_rad) * body.rear_m;
  const double half_m = std::max(std::abs(std::cos(turned_rad)) * body.width_m / 2.0 - body_over_line_m, 0.0);
  const double right_t_m = origin.t_m + std::min(to_front_m, to_rear_m) - half_m;
  const double left_t_m = origin.t_m + std::max(to_front_m, to_rear_m) + half_m;
  LaneRange range;
  for (const double t_m : {right_t_m, (right_t_m + left_t_m) / 2.0, left_t_m}) {
    const LanesAt at = lanes_at(network.roads[origin.road], origin.s_m, t_m);
    if (at.lane == 0 || at.lane != at.lane_any_type || at.outside_m > 0.0) continue;
    range = range.empty() ? LaneRange{at.lane, at.lane}
                          : LaneRange{std::min(range.lowest, at.lane), std::max(range.highest, at.lane)};
  }
  return range;
}

}  // namespace septet::road
