#pragma once
/// The lanes under a body on the road: in a lane, stopped on the hard shoulder, on the line.

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::road {

/// A body's rectangle on the ground, with its origin on the road.
struct BodyOutline {
  double heading_rad = 0.0;            ///< World frame.
  double rear_m = 0.0, front_m = 0.0;  ///< From the origin to its ends, both positive.
  double width_m = 0.0;
};

/// OpenDRIVE ids of neighbouring lanes; empty by default.
struct LaneRange {
  int lowest = 1, highest = 0;

  bool empty() const { return lowest > highest; }
  bool contains(int lane) const { return lowest <= lane && lane <= highest; }
};

/// Overlap from which on a body across a lane's line is in that lane, too.
inline constexpr double body_over_line_m = 0.2;

/// The driving lanes that the body lies over. One that stands on the shoulder is in none of them, unless it reaches
/// over the edge line.
LaneRange drivable_lanes_under(const RoadNetwork& network, const RoadPosition& origin, const BodyOutline& body);

}  // namespace septet::road
