#pragma once
/// One direction of a road for traffic: a single coordinate x along the direction of travel, and lanes.
///
/// Roads that follow each other are strung together, so that the distance between two vehicles is a subtraction
/// anywhere. A lane is counted outwards from the middle of the road (1 is the left-most in right-hand traffic), which
/// is the magnitude of its OpenDRIVE id. Immutable once built; pure functions.

#include <cmath>
#include <optional>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/road/road_position.hpp"

namespace septet::traffic {

struct CorridorPiece {
  road::RoadIndex road = 0;
  bool along_s = true;  ///< True where travel runs towards increasing s.
  int side = -1;        ///< Sign of the lane ids: −1 right of the reference line, +1 left of it.
  double x_m = 0.0;     ///< x of the piece's beginning.
  double length_m = 0.0;
};

struct Corridor {
  std::vector<CorridorPiece> pieces;
  double length_m = 0.0;
  bool closed = false;  ///< A ring: x wraps at length_m.
};

/// The corridor through a lane, from the roads' beginning to their end (or back to itself).
Corridor build_corridor(const road::RoadNetwork& network, const road::LanePosition& through);
/// The lane of the opposite direction beside this one, if there is one.
std::optional<road::LanePosition> opposite_lane(const road::RoadNetwork& network, const road::LanePosition& position);

/// x wrapped on a ring, or unchanged on an open corridor.
inline double wrap_x(const Corridor& corridor, double x_m) {
  return corridor.closed ? x_m - corridor.length_m * std::floor(x_m / corridor.length_m) : x_m;
}
/// Distance from → to along the direction of travel, the shorter one on a ring; negative if `to_x_m` lies behind.
inline double distance_m(const Corridor& corridor, double from_x_m, double to_x_m) {
  const double d = to_x_m - from_x_m;
  return corridor.closed ? d - corridor.length_m * std::round(d / corridor.length_m) : d;
}

/// Length from x on to `ahead_m` further by x (negative: back), in metres of lane `lane`'s middle.
double length_along_lane_m(const road::RoadNetwork& network, const Corridor& corridor, int lane, double x_m,
                           double ahead_m, double step_m);

const CorridorPiece& piece_at(const Corridor& corridor, double x_m);
/// The position of lane `lane` at x, whether or not that lane can be driven on.
road::LanePosition position_at(const Corridor& corridor, double x_m, int lane);
/// True where the lane exists and is a driving lane.
bool lane_open(const road::RoadNetwork& network, const Corridor& corridor, double x_m, int lane);
/// x of a road position; empty where its road is not of this corridor or it is on the other side of the road.
std::optional<double> x_of(const road::RoadNetwork& network, const Corridor& corridor,
                           const road::RoadPosition& position, int lane);

}  // namespace septet::traffic
