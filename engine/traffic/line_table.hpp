#pragma once
/// The road's reference line along a corridor, looked up once: the road data of a vehicle's pose at every tick, without
/// a search for records and without angles.

#include <array>
#include <cstdint>
#include <vector>

#include "engine/math/rigid_transform.hpp"
#include "engine/traffic/corridor.hpp"

namespace septet::traffic {

/// The line at one station, as a frame: x towards increasing s, y to the left and banked as the
/// road, on the reference line.
struct RoadLine {
  RigidTransform world_from_line;
  double curvature_per_m = 0.0;  ///< In the plan; positive turns left of increasing s.
};

/// Every `step_m` of x a cubic of the part of the step for each number of the frame, through four stations of the road.
/// Where that would be off by more than a micrometre (a record begins, a road ends) the road is queried.
struct LineTable {
  static constexpr double step_m = 10.0;

  /// [power][number]: position x, y, z; orientation w, x, y, z; curvature.
  using Cubics = std::array<std::array<double, 8>, 4>;
  static constexpr std::uint32_t no_piece = 0xffffffff;

  std::vector<std::uint32_t> pieces;  ///< Piece of the corridor, per step; no_piece: the road is queried.
  std::vector<Cubics> cubics;         ///< Per step.
};

LineTable make_line_table(const road::RoadNetwork& network, const Corridor& corridor);

/// The road's line at x, which lies within the corridor, and its piece.
struct LineAt {
  const CorridorPiece& piece;
  double s_m = 0.0;  ///< On the piece's road.
  RoadLine line;
};
LineAt line_at(const road::RoadNetwork& network, const Corridor& corridor, const LineTable& table, double x_m);

/// (cos, sin) of half the angle that has this cosine and sine.
Vec2 half_turn(double cosine, double sine);

}  // namespace septet::traffic
