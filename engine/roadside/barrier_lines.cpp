#include "engine/roadside/barrier_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/town.hpp"

namespace septet::roadside {

double BesideLine::t_at(double s_m) const {
  return s1_m > s0_m ? std::lerp(t0_m, t1_m, (s_m - s0_m) / (s1_m - s0_m)) : t0_m;
}

std::vector<double> stations(const RoadTile& tile, const BesideLine& line, double step_m) {
  RoadTile part = tile;
  part.s0_m = std::max(tile.s0_m, line.s0_m);
  part.s1_m = std::min(tile.s1_m, line.s1_m);
  if (part.s1_m - part.s0_m < 0.5) return {};
  return stations(part, step_m);
}

std::vector<Barrier> barriers(const RoadShape& roads, const RoadTile& tile) {
  std::vector<Barrier> result;
  const double length = roads.road(tile.road).length_m;
  for (const road::RoadObject& object : roads.road(tile.road).objects) {
    if (object.type != "barrier") continue;
    Barrier barrier;
    if (object.subtype == "jerseyBarrier") barrier.form = BarrierForm::jersey;
    if (object.subtype == "railing") barrier.form = BarrierForm::railing;
    if (barrier.form == BarrierForm::rail && tile.in_tunnel) continue;
    for (const road::ObjectRepeat& repeat : object.repeats) {
      barrier.line = {repeat.s_m, repeat.s_m + repeat.length_m, repeat.t_start_m, repeat.t_end_m};
      // What runs to a loose end of the road runs on with it.
      if (barrier.line.s0_m < 0.01) barrier.line.s0_m = roads.begin_m(tile.road);
      if (barrier.line.s1_m > length - 0.01) barrier.line.s1_m = roads.end_m(tile.road);
      result.push_back(barrier);
    }
  }
  return result;
}

std::vector<BesideLine> noise_walls(const RoadShape& roads, const RoadTile& tile) {
  const road::Road& road = roads.road(tile.road);
  if (road.types.empty() || road.types.front().type != "motorway" || road.length_m < 2000.0) return {};
  constexpr std::array<std::array<double, 3>, 3> walls{
      {{1900.0, 2450.0, 1.0}, {4500.0, 4900.0, -1.0}, {5350.0, 5750.0, 1.0}}};
  std::vector<BesideLine> result;
  for (const auto& [from, to, side] : walls) {
    if (to > road.length_m) continue;
    const road::RoadExtent extent = road::road_extent(road, from);
    const double t = side > 0 ? extent.left_t_m + 2.6 : extent.right_t_m - 2.6;
    result.push_back({from, to, t, t});
  }
  return result;
}

std::vector<BesideLine> marker_posts(const RoadShape& roads, const RoadTile& tile) {
  std::vector<BesideLine> result;
  if (tile.in_tunnel || tile.on_bridge || roads.road(tile.road).junction != road::no_index ||
      is_in_town(roads.network(), tile.road, tile.middle_m()))
    return result;
  for (double s = std::ceil(tile.s0_m / 50.0) * 50.0; s < tile.s1_m; s += 50.0) {
    const road::RoadExtent extent = road::road_extent(roads.road(tile.road), s);
    for (const double side : {1.0, -1.0}) {
      const double t = (side > 0 ? extent.left_t_m : extent.right_t_m) + side * 1.2;
      result.push_back({s - 0.5, s + 0.5, t, t});
    }
  }
  return result;
}

}  // namespace septet::roadside
