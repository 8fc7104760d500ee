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
  /// Of a route's piece, which is one lane section: its least s; how far within its ends stations are taken, so that
  /// they are of this section; and what is added to the magnitude of a lane's id, so that a route's lane keeps its
  /// number from piece to piece.
  double from_s_m = 0.0, inset_m = 0.0;
  int lane_shift = 0;
  int lane = 0;  ///< Of a route's piece: id of the lane in which it is left.
};

struct Corridor {
  std::vector<CorridorPiece> pieces;
  double length_m = 0.0;
  bool closed = false;    ///< A ring: x wraps at length_m.
  bool is_route = false;  ///< A stretch of a route: x begins anywhere.
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

/// The piece of a road position: of several of one road the one that holds it, or comes nearest; null: its road is not
/// of this corridor.
const CorridorPiece* piece_of(const Corridor& corridor, const road::RoadPosition& position);
/// x of a station on a piece.
inline double x_on_piece(const CorridorPiece& piece, double s_m) {
  const double along_m = s_m - piece.from_s_m;
  return piece.x_m + (piece.along_s ? along_m : piece.length_m - along_m);
}
const CorridorPiece& piece_at(const Corridor& corridor, double x_m);
/// The position of lane `lane` at x, whether or not that lane can be driven on.
road::LanePosition position_at(const Corridor& corridor, double x_m, int lane);
/// True where the lane exists and is a driving lane.
bool lane_open(const road::RoadNetwork& network, const Corridor& corridor, double x_m, int lane);
/// x of a road position; empty where its road is not of this corridor or it is on the other side of the road.
std::optional<double> x_of(const road::RoadNetwork& network, const Corridor& corridor,
                           const road::RoadPosition& position, int lane);

}  // namespace septet::traffic
