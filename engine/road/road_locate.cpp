#include "engine/road/road_locate.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/core/check.hpp"
#include "engine/road/cross_section.hpp"

namespace septet::road {
namespace {

/// Foot of a point on a road.
struct Foot {
  double s_m = 0.0, t_m = 0.0;
  double gap_m = 0.0;  ///< Distance of the point beyond the road's end (or off a break in its geometry); else 0.
};

/// Distance of the point ahead of the cross-section, and its t there.
struct Offset {
  double ahead_m = 0.0, t_m = 0.0;
};

/// Offset on a road whose cross-sections are upright.
Offset offset_from(const PlanPoint& plan, const Vec2& world_m) {
  const Vec2 d = world_m - plan.position_m;
  return {glm::dot(d, plan.direction), plan.direction.x * d.y - plan.direction.y * d.x};
}

Offset offset_from(const Road& road, const CrossSection& section, const Vec2& world_m, double s, double t_before) {
  const auto [along, across] = offset_from(section.plan, world_m);
  double h = 0.0, t = t_before;
  // The surface's height at t moves t: each round leaves its cross slope times the bank of the error.
  for (int round = 0; round < 24; ++round) {
    h = surface_offset_m(road, s, t);
    const double before = std::exchange(t, (across + h * section.sin_roll) / section.cos_roll);
    if (road.flat || std::abs(t - before) < 1e-10) break;
  }
  return {along - section.sin_pitch * (t * section.sin_roll + h * section.cos_roll), t};
}

/// Moves `foot` by `ahead_m / slope`, within the road; returns the distance.
double step_foot(const Road& road, double ahead_m, double slope, Foot& foot) {
  const double target = foot.s_m + std::clamp(ahead_m / slope, -100.0, 100.0);
  if (!std::isfinite(target)) return 0.0;
  const double before = std::exchange(foot.s_m, std::clamp(target, 0.0, road.length_m));
  return std::abs(foot.s_m - before);
}

/// Solves ahead(s) = 0 in the plan by Newton's method, with the slope −(1 − κt). The remaining error is the square of
/// the last step.
Foot foot_on_plan(const Road& road, const Vec2& world_m, double s, double last_step_m) {
  Foot foot;
  foot.s_m = std::clamp(s, 0.0, road.length_m);
  for (int iteration = 0; iteration < 24; ++iteration) {
    const PlanPoint plan = evaluate_plan(road.plan, foot.s_m);
    const Offset offset = offset_from(plan, world_m);
    foot.t_m = offset.t_m;
    foot.gap_m = std::abs(offset.ahead_m);
    const double slope = std::max(1.0 - plan.curvature_per_m * offset.t_m, 0.1);
    if (step_foot(road, offset.ahead_m, slope, foot) < last_step_m) break;
  }
  return foot;
}

/// Foot of a point: where banking on a changing grade moves the cross-section along the road, the secant method
/// continues from the foot in the plan.
Foot foot_on(const Road& road, const Vec2& world_m, double s) {
  const bool plane = road.flat && road.superelevation.empty();
  Foot foot = foot_on_plan(road, world_m, s, plane ? 1e-6 : 1e-3);
  double s_before = foot.s_m, ahead_before = 0.0;
  for (int iteration = 0; !plane && iteration < 24; ++iteration) {
    const CrossSection section = cross_section_at(road, foot.s_m);
    const Offset offset = offset_from(road, section, world_m, foot.s_m, foot.t_m);
    foot.t_m = offset.t_m;
    foot.gap_m = std::abs(offset.ahead_m);
    double slope = std::max(1.0 - section.plan.curvature_per_m * offset.t_m, 0.1);
    if (iteration > 0 && foot.s_m != s_before) {
      const double secant = (ahead_before - offset.ahead_m) / (foot.s_m - s_before);
      if (secant > 0.05 && secant < 20.0) slope = secant;
    }
    s_before = foot.s_m;
    ahead_before = offset.ahead_m;
    // The secant's error falls nearly with the square of the step: further ones gain nothing.
    if (step_foot(road, offset.ahead_m, slope, foot) < 1e-6) break;
  }
  if (foot.gap_m < 1e-4) foot.gap_m = 0.0;
  return foot;
}

Location location_on(const RoadNetwork& network, RoadIndex index, const Vec2& world_m, double s) {
  const Road& road = network.roads[index];
  const Foot foot = foot_on(road, world_m, s);
  Location location{{index, foot.s_m, foot.t_m}, lanes_at(road, foot.s_m, foot.t_m)};
  if (foot.gap_m > 0.0) location.lanes.outside_m = std::hypot(location.lanes.outside_m, foot.gap_m);
  return location;
}

/// True where `a` is the better result: it contains the point or is nearer to it; of two that contain it the one
/// outside junctions, then the one whose lane centre is nearer.
bool better(const RoadNetwork& network, const Location& a, const Location& b) {
  if (a.lanes.outside_m != b.lanes.outside_m) return a.lanes.outside_m < b.lanes.outside_m;
  const bool a_in_junction = network.roads[a.position.road].junction != no_index;
  const bool b_in_junction = network.roads[b.position.road].junction != no_index;
  if (a_in_junction != b_in_junction) return b_in_junction;
  return std::abs(a.lanes.offset_m) < std::abs(b.lanes.offset_m);
}

/// Roads that part overlap at first: of those that contain the point equally well, the first of the file.
constexpr double as_good_m = 0.01;

/// Tries the roads linked to the end of the hint's road that the point has passed.
std::optional<Location> locate_beyond_end(const RoadNetwork& network, const Location& at_end, const Vec2& world_m) {
  const RoadIndex from = at_end.position.road;
  const Road& road = network.roads[from];
  const RoadLink& link = at_end.position.s_m > 0.5 * road.length_m ? road.successor : road.predecessor;
  std::optional<Location> best;
  const auto consider = [&](RoadIndex index, double s) {
    const Location location = location_on(network, index, world_m, s);
    if (location.lanes.outside_m > 0.0) return;
    if (!best || std::abs(location.lanes.offset_m) < std::abs(best->lanes.offset_m) - as_good_m) best = location;
  };
  const auto end_of = [&](RoadIndex index, ContactPoint contact) {
    return contact == ContactPoint::start ? 0.0 : network.roads[index].length_m;
  };
  if (link.road != no_index) consider(link.road, end_of(link.road, link.contact));
  if (link.junction == no_index) return best;
  for (const JunctionConnection& connection : network.junctions[link.junction].connections) {
    if (connection.incoming == from) consider(connection.connecting, end_of(connection.connecting, connection.contact));
  }
  return best;
}

double distance_to(const StretchNode& box, const Vec2& world_m) {
  return glm::length(glm::max(glm::max(box.low_m - world_m, world_m - box.high_m), Vec2(0.0)));
}

double surface_z_m(const RoadNetwork& network, const RoadPosition& at) {
  const Road& road = network.roads[at.road];
  return cross_section_at(road, at.s_m).place(at.t_m, surface_offset_m(road, at.s_m, at.t_m)).z;
}

/// The best of all roads, or of those whose surface lies near `level_m`.
std::optional<Location> locate_on_level(const RoadNetwork& network, const Vec2& world_m, double reach_m,
                                        std::optional<double> level_m) {
  std::optional<Location> best;
  double reach = reach_m;
  for (std::size_t i = 0; i < network.stretches.size();) {
    const StretchNode& node = network.stretches[i];
    if (distance_to(node, world_m) > reach) {
      i = node.skip;
      continue;
    }
    ++i;
    if (node.road == no_index) continue;
    const double middle = node.s_m + 0.5 * node.step_m;
    // Neighbouring stretches find the same foot: once is enough.
    if (best && best->position.road == node.road && best->lanes.outside_m == 0.0 &&
        std::abs(best->position.s_m - middle) < 2.0 * node.step_m) {
      continue;
    }
    const Location location = location_on(network, node.road, world_m, middle);
    if (location.lanes.outside_m > reach_m || (best && !better(network, location, *best))) continue;
    if (level_m && !(std::abs(surface_z_m(network, location.position) - *level_m) < level_reach_m)) continue;
    best = location;
    reach = location.lanes.outside_m;
  }
  return best;
}

std::optional<Location> locate_anywhere(const RoadNetwork& network, const Vec2& world_m, double reach_m,
                                        std::optional<double> level_m) {
  if (level_m)
    if (const auto found = locate_on_level(network, world_m, reach_m, level_m)) return found;
  return locate_on_level(network, world_m, reach_m, std::nullopt);
}

/// Way along a surface from `point` by `step_m`: ahead, or up to the point where that is less steep, since the first may
/// cross a step. `at(step)`: the surface's point beside it.
template <class At>
Vec3 way_on_surface(const Vec3& point, double step_m, At at) {
  constexpr double steep = 0.1;
  const Vec3 ahead = at(step_m) - point;
  if (std::abs(ahead.z) < steep * std::abs(step_m)) return ahead;
  const Vec3 behind = point - at(-step_m);
  const bool is_whole = glm::length(behind) > 0.5 * std::abs(step_m);  // It may end with the road.
  return is_whole && std::abs(behind.z) < std::abs(ahead.z) ? behind : ahead;
}

}  // namespace

std::optional<Location> locate(const RoadNetwork& network, const Vec2& world_m, const RoadPosition* hint,
                               double reach_m, std::optional<double> level_m) {
  if (!std::isfinite(world_m.x) || !std::isfinite(world_m.y)) return std::nullopt;
  if (hint == nullptr) return locate_anywhere(network, world_m, reach_m, level_m);
  SEPTET_CHECK(hint->road < network.roads.size(), "hint names road {} of {}", hint->road, network.roads.size());
  const Location near = location_on(network, hint->road, world_m, hint->s_m);
  if (near.lanes.outside_m == 0.0) return near;
  const double length = network.roads[hint->road].length_m;
  if (near.position.s_m <= 0.0 || near.position.s_m >= length) {
    if (const auto beyond = locate_beyond_end(network, near, world_m)) return beyond;
  }
  return locate_anywhere(network, world_m, reach_m, level_m);
}

/// Places of one road farther apart along it are two: it turns over itself.
constexpr double over_itself_m = 30.0;

std::vector<Location> roads_holding(const RoadNetwork& network, const Vec2& world_m) {
  std::vector<Location> holding;
  if (!std::isfinite(world_m.x) || !std::isfinite(world_m.y)) return holding;
  for (std::size_t i = 0; i < network.stretches.size();) {
    const StretchNode& node = network.stretches[i];
    if (distance_to(node, world_m) > 0.0) {
      i = node.skip;
      continue;
    }
    ++i;
    if (node.road == no_index) continue;
    const auto is_found_at = [&](double s_m) {
      return std::ranges::any_of(holding, [&](const Location& found) {
        return found.position.road == node.road && std::abs(found.position.s_m - s_m) < over_itself_m;
      });
    };
    if (is_found_at(node.s_m + 0.5 * node.step_m)) continue;
    const Location location = location_on(network, node.road, world_m, node.s_m + 0.5 * node.step_m);
    if (location.lanes.outside_m == 0.0 && !is_found_at(location.position.s_m)) holding.push_back(location);
  }
  return holding;
}

std::optional<SurfacePoint> surface_at(const RoadNetwork& network, const Vec2& world_m, const RoadPosition* hint,
                                       double reach_m, std::optional<double> level_m) {
  const auto location = locate(network, world_m, hint, reach_m, level_m);
  if (!location) return std::nullopt;
  const Road& road = network.roads[location->position.road];
  const double s = location->position.s_m, t = location->position.t_m;
  const CrossSection section = cross_section_at(road, s);
  const Vec3 point = section.place(t, surface_offset_m(road, s, t));
  SurfacePoint surface{location->position, point.z};
  surface.outside_m = location->lanes.outside_m;
  if (road.flat && road.superelevation.empty()) {
    const Vec2 uphill = section.grade / (1.0 - section.plan.curvature_per_m * t) * section.plan.direction;
    surface.normal = glm::normalize(Vec3(-uphill.x, -uphill.y, 1.0));
    return surface;
  }
  // Across the surface and along it, by differences over a centimetre that stay on the road.
  constexpr double beside_m = 0.01;
  const double ds = s + beside_m <= road.length_m ? beside_m : -beside_m;
  const auto along_road = [&](double ds_m) {
    const double there = std::clamp(s + ds_m, 0.0, road.length_m);
    return cross_section_at(road, there).place(t, surface_offset_m(road, there, t));
  };
  const auto across_road = [&](double dt_m) { return section.place(t + dt_m, surface_offset_m(road, s, t + dt_m)); };
  const Vec3 along = way_on_surface(point, ds, along_road) / ds;
  const Vec3 across = way_on_surface(point, beside_m, across_road);
  surface.normal = glm::normalize(glm::cross(along, across));
  return surface;
}

}  // namespace septet::road
