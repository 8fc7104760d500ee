#pragma once
/// Guard rails, walls and marker posts along a road, for the scenery that draws them and the cars that run against
/// them.
///
/// A line is straight in road coordinates; it becomes a polyline through its stations in each tile, and both users take
/// the same ones.

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "engine/roadside/road_shape.hpp"

namespace septet::roadside {

struct BesideLine {
  double s0_m, s1_m, t0_m, t1_m;
  double t_at(double s_m) const;
};

/// Stations of the part of the line within the tile, both ends included, at most `step_m` apart; empty where less than
/// half a metre of it lies there.
std::vector<double> stations(const RoadTile& tile, const BesideLine& line, double step_m);

enum class BarrierForm : std::uint8_t { rail, jersey, railing, wall, fence, hedge };
inline constexpr std::array barrier_forms{BarrierForm::rail, BarrierForm::jersey, BarrierForm::railing,
                                          BarrierForm::wall, BarrierForm::fence,  BarrierForm::hedge};
/// Overhang of a parapet's handrail, which lies on its posts.
inline constexpr double handrail_over_posts_m = 0.02;
/// Height of a barrier of this form where the file gives no height.
double usual_height_m(BarrierForm form);
struct Barrier {
  BarrierForm form = BarrierForm::rail;
  BesideLine line{};
  double height0_m = 0.0, height1_m = 0.0;  ///< Height of its upper edge over the road, where the line begins and ends.
  double width_m = 0.0;                     ///< Width of walls and hedges; 0: a usual one.

  double height_at(double s_m) const;
};
/// True for an object that is a barrier by its type (OpenDRIVE 1.8, §13.14; older files name the form itself);
/// `runs_along` if it stands along a line of its road: on repeats that are continuous or nearly so, or along the road
/// as long as it is. Others stand alone (standing_objects.hpp).
bool is_barrier(const road::RoadObject& object);
bool runs_along(const road::RoadObject& object);
/// Barriers of the tile's road that stand in the tile: rails end at a tunnel's mouth. A bridge that the file does not
/// give (road/decks.hpp) has railings.
std::vector<Barrier> barriers(const RoadShape& roads, const RoadTile& tile);
inline constexpr double barrier_step_m = 10.0;

/// Stretches of wall between a motorway and the few houses.
std::vector<BesideLine> noise_walls(const RoadShape& roads, const RoadTile& tile);
inline constexpr double noise_wall_step_m = 8.0;

/// Reflecting posts every 50 m behind the rail. Left out in towns and junctions, on or right beside another road's
/// lanes, and where the file gives its own. Each stands at the first station of its line, which is a metre long.
std::vector<BesideLine> marker_posts(const RoadShape& roads, const RoadTile& tile);
inline constexpr double marker_post_step_m = 2.0;

}  // namespace septet::roadside
