#pragma once
/// Where guard rails, walls and marker posts stand along a road: what the scenery draws and what cars run against.
///
/// A line is straight in road coordinates; it becomes a polyline through its stations in each tile, and both users take the
/// same ones.

#include <string_view>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

struct BesideLine {
  double s0_m, s1_m, t0_m, t1_m;
  double t_at(double s_m) const;
};

/// Stations of the part of the line within the tile, both ends included, at most `step_m` apart; none where less than half a
/// metre of it lies there.
std::vector<double> stations(const RoadTile& tile, const BesideLine& line, double step_m);

enum class BarrierForm : std::uint8_t { rail, jersey, railing };
struct Barrier {
  BarrierForm form = BarrierForm::rail;
  BesideLine line{};
};
/// The barriers of the tile's road that stand in the tile: rails end at a tunnel's mouth.
std::vector<Barrier> barriers(const RoadShape& roads, const RoadTile& tile);
inline constexpr double barrier_step_m = 10.0;

/// Stretches of wall between a motorway and the few houses.
std::vector<BesideLine> noise_walls(const RoadShape& roads, const RoadTile& tile);
inline constexpr double noise_wall_step_m = 8.0;

/// Reflecting posts every 50 m behind the rail, none in towns and junctions; each stands at the first station of its line, which is a metre long.
std::vector<BesideLine> marker_posts(const RoadShape& roads, const RoadTile& tile);
inline constexpr double marker_post_step_m = 2.0;

}  // namespace septet::roadside
