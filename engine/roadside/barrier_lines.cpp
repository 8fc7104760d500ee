#include "engine/roadside/barrier_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "engine/road/decks.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/mentions.hpp"
#include "engine/roadside/obstacle_profile.hpp"
#include "engine/roadside/town.hpp"

namespace septet::roadside {
namespace {

constexpr double post_out_m = 1.2, post_clear_m = 0.5;
constexpr double least_line_m = 0.5, highest_barrier_m = 12.0, widest_barrier_m = 3.0;

BarrierForm form_of(const road::RoadObject& object) {
  const auto says = [&](std::string_view word) {
    return mentions(object.subtype, word) || mentions(object.type, word) ||
           (object.subtype.empty() && mentions(object.name, word));
  };
  if (says("jersey") || says("concrete")) return BarrierForm::jersey;
  if (says("wall") || says("noise") || says("sound")) return BarrierForm::wall;
  if (says("hedge")) return BarrierForm::hedge;
  if (says("fence")) return BarrierForm::fence;
  // A railing that hangs over the ground is a guard rail's sheet.
  const bool hangs = !object.repeats.empty() && object.repeats.front().z_offset_start_m > 0.2;
  return says("railing") && !hangs ? BarrierForm::railing : BarrierForm::rail;
}

/// Repeats of an object; an object without repeats reaches half its length to either side.
std::vector<road::ObjectRepeat> repeats_of(const road::RoadObject& object) {
  if (!object.repeats.empty()) return object.repeats;
  road::ObjectRepeat one;
  one.s_m = std::max(0.0, object.s_m - 0.5 * object.length_m);
  one.length_m = object.s_m + 0.5 * object.length_m - one.s_m;
  one.t_start_m = one.t_end_m = object.t_m;
  one.width_start_m = one.width_end_m = object.width_m;
  one.height_start_m = one.height_end_m = object.height_m;
  one.z_offset_start_m = one.z_offset_end_m = object.z_offset_m;
  return {one};
}

bool gives_posts(const road::Road& road) {
  return std::ranges::any_of(road.objects, [](const road::RoadObject& object) {
    return mentions(object.type, "guide-post") || mentions(object.type, "guidepost") ||
           mentions(object.subtype, "delineator");
  });
}

/// True if lanes of some road lie under a post or within `clear_m` beside it: a place beside one road may lie on
/// another, as the gore of an exit does.
bool is_on_lanes(const RoadShape& roads, road::RoadIndex index, double s_m, double t_m, double clear_m) {
  const auto holds = [&](double t) {
    const auto found = road::roads_holding(roads.network(), Vec2(roads.point(index, s_m, t)));
    return std::ranges::any_of(found, [&](const road::Location& location) {
      return road::lane_type(roads.network(), location.position.road, location.lanes.lane_any_type,
                             location.position.s_m) != road::LaneType::none;
    });
  };
  return holds(t_m) || holds(t_m - clear_m) || holds(t_m + clear_m);
}

/// True where lanes as high as a deck lie beside it, as where it parts.
bool is_beside_lanes(const RoadShape& roads, road::RoadIndex index, double s_m, double t_m) {
  const Vec3 at = roads.point(index, s_m, t_m);
  for (const road::Location& other : road::roads_holding(roads.network(), Vec2(at)))
    if (std::abs(road::evaluate(roads.network(), other.position).position_m.z - at.z) < road::least_rise_m / 2)
      return true;
  return false;
}

/// Adds railings along both edges of a deck that its file does not know of, but where other lanes join it.
void add_parapets(const RoadShape& roads, const RoadTile& tile, std::vector<Barrier>& barriers) {
  constexpr double step_m = 8.0, out_m = 0.4;
  const std::vector<double> along = stations(tile, step_m);
  for (const double side : {1.0, -1.0})
    for (std::size_t i = 1; i < along.size(); ++i) {
      const auto t_at = [&](double s_m) {
        const road::RoadExtent extent = road::road_extent(roads.road(tile.road), s_m);
        return side > 0 ? extent.left_t_m + out_m : extent.right_t_m - out_m;
      };
      const double from = along[i - 1], to = along[i], middle = 0.5 * (from + to);
      if (is_beside_lanes(roads, tile.road, from + 0.01, t_at(from)) ||
          is_beside_lanes(roads, tile.road, middle, t_at(middle)) ||
          is_beside_lanes(roads, tile.road, to - 0.01, t_at(to)))
        continue;
      Barrier parapet;
      parapet.form = BarrierForm::railing;
      parapet.height0_m = parapet.height1_m = usual_height_m(parapet.form);
      parapet.line = {from, to, t_at(from), t_at(to)};
      barriers.push_back(parapet);
    }
}

}  // namespace

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

double usual_height_m(BarrierForm form) {
  switch (form) {
    case BarrierForm::rail:
      return profile_of(ObstacleKind::guard_rail).height_m;
    case BarrierForm::jersey:
      return profile_of(ObstacleKind::concrete_barrier).height_m;
    case BarrierForm::railing:
      return profile_of(ObstacleKind::parapet).height_m + handrail_over_posts_m;
    case BarrierForm::wall:
      return 2.0;
    case BarrierForm::fence:
      return 1.5;
    case BarrierForm::hedge:
      return 1.2;
  }
  return 1.0;
}

double Barrier::height_at(double s_m) const {
  const double share = line.s1_m > line.s0_m ? std::clamp((s_m - line.s0_m) / (line.s1_m - line.s0_m), 0.0, 1.0) : 0.0;
  return std::lerp(height0_m, height1_m, share);
}

bool is_barrier(const road::RoadObject& object) {
  for (const std::string_view word : {"barrier", "railing", "guardrail", "guard_rail", "fence"})
    if (mentions(object.type, word)) return !object.material;
  return false;
}

bool runs_along(const road::RoadObject& object) {
  if (object.repeats.empty())
    return object.outlines.empty() && object.length_m >= least_line_m && std::abs(std::sin(object.heading_rad)) < 0.1;
  return std::ranges::all_of(object.repeats, [&](const road::ObjectRepeat& repeat) {
    return repeat.distance_m <= 0.0 || repeat.distance_m <= 1.2 * object.length_m || object.length_m <= 0.0;
  });
}

std::vector<Barrier> barriers(const RoadShape& roads, const RoadTile& tile) {
  std::vector<Barrier> result;
  const double length = roads.road(tile.road).length_m;
  for (const road::RoadObject& object : roads.road(tile.road).objects) {
    if (!is_barrier(object) || !runs_along(object)) continue;
    Barrier barrier;
    barrier.form = form_of(object);
    if (barrier.form == BarrierForm::rail && tile.in_tunnel) continue;
    for (const road::ObjectRepeat& repeat : repeats_of(object)) {
      const auto height_m = [&](double up_m, double high_m) {
        return high_m > 0.0 ? std::clamp(up_m + high_m, 0.1, highest_barrier_m) : usual_height_m(barrier.form);
      };
      barrier.height0_m = height_m(repeat.z_offset_start_m, repeat.height_start_m);
      barrier.height1_m = height_m(repeat.z_offset_end_m, repeat.height_end_m);
      barrier.width_m = std::min(repeat.width_start_m, widest_barrier_m);
      barrier.line = {repeat.s_m, repeat.s_m + repeat.length_m, repeat.t_start_m, repeat.t_end_m};
      // A barrier that reaches a loose end of the road runs on with it.
      if (barrier.line.s0_m < 0.01) barrier.line.s0_m = roads.begin_m(tile.road);
      if (barrier.line.s1_m > length - 0.01) barrier.line.s1_m = roads.end_m(tile.road);
      result.push_back(barrier);
    }
  }
  if (const road::RoadStructure* deck =
          roads.structure_at(tile.road, tile.middle_m(), road::RoadStructure::Kind::bridge);
      deck && deck->inferred)
    add_parapets(roads, tile, result);
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
      is_in_town(roads.network(), tile.road, tile.middle_m()) || gives_posts(roads.road(tile.road)))
    return result;
  for (double s = std::ceil(tile.s0_m / 50.0) * 50.0; s < tile.s1_m; s += 50.0) {
    const road::RoadExtent extent = road::road_extent(roads.road(tile.road), s);
    for (const double side : {1.0, -1.0}) {
      const double t = (side > 0 ? extent.left_t_m : extent.right_t_m) + side * post_out_m;
      if (!is_on_lanes(roads, tile.road, std::max(s - 0.5, tile.s0_m), t, post_clear_m))
        result.push_back({s - 0.5, s + 0.5, t, t});
    }
  }
  return result;
}

}  // namespace septet::roadside
