#include "engine/scenario/run/path_motion.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/road_locate.hpp"
#include "engine/scenario/run/path.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {
namespace {

constexpr double fastest_mps = 200.0;
constexpr double beside_lane_m = 0.5;  ///< An entity further beside the road is in no lane of it.

/// Upright on the surface below, else level.
RigidTransform pose_on_ground(const road::RoadNetwork& network, const PathPoint& point,
                              const road::RoadPosition* hint) {
  RigidTransform pose{point.position_m, orientation_from_angles(point.heading_rad, 0.0, 0.0)};
  const auto surface = road::surface_at(network, Vec2(point.position_m), hint);
  if (!surface) return pose;
  pose.position_m.z = surface->height_m;
  const Vec3 ahead(std::cos(point.heading_rad), std::sin(point.heading_rad), 0.0);
  const Vec3 left = glm::normalize(glm::cross(surface->normal, ahead));
  pose.orientation = glm::quat_cast(glm::dmat3(glm::cross(left, surface->normal), left, surface->normal));
  return pose;
}

}  // namespace

bool start_path(const road::RoadNetwork& network, const ScenarioState& state, const FollowTrajectoryAction& what,
                ElementIndex action, EntityState& entity) {
  if (!entity.active) return false;
  auto path = lay_path(network, state, entity, what.trajectory);
  if (!path) return false;
  for (PathPoint& point : path->points) point.time_s = what.time_scale * point.time_s + what.time_offset_s;
  PathControl control;
  control.active = true;
  control.action = action;
  control.timed = what.timed;
  control.clock_s = what.from_simulation_start ? state.time_s : 0.0;
  control.station_m = what.initial_distance_m;
  if (what.timed) {
    // The path before the initial distance is cut off, and so is its time.
    if (what.initial_distance_m > 0.0) control.clock_s += path_at_station(*path, what.initial_distance_m).time_s;
    control.station_m = path_at_time(*path, control.clock_s).s_m;
  }
  control.path = std::make_shared<const Path>(std::move(*path));
  entity.path_control = control;
  return true;
}

double follow_path(const road::RoadNetwork& network, double way_m, double dt_s, EntityState& entity,
                   std::vector<ElementIndex>& ended) {
  PathControl& control = entity.path_control;
  const Path& path = *control.path;
  control.clock_s += dt_s;
  const PathPoint point =
      control.timed ? path_at_time(path, control.clock_s) : path_at_station(path, control.station_m + way_m);
  const double gone_m = control.timed ? point.s_m - control.station_m : way_m;
  // A trajectory that demands a higher speed jumps there.
  if (control.timed && std::abs(gone_m) <= fastest_mps * dt_s) entity.speed_mps = gone_m / dt_s;
  control.station_m = std::max(0.0, control.station_m + gone_m);
  entity.travelled_m += std::abs(gone_m);
  entity.at_road_end_s = 0.0;

  const double t = entity.on_road ? lateral_t_m(network, entity.lane) : 0.0;
  const road::RoadPosition hint{entity.lane.road, entity.lane.s_m, t};
  const road::RoadPosition* near = entity.on_road ? &hint : nullptr;
  entity.world_from_entity = pose_on_ground(network, point, near);
  const Placement placement = place_at(entity.world_from_entity, network, near, beside_lane_m);
  entity.on_road = placement.on_road;
  entity.lane = placement.lane;
  entity.along_s = placement.along_s;
  entity.heading_offset_rad = placement.heading_offset_rad;

  const bool done =
      control.timed ? control.clock_s >= path.end_s() - 1e-9 : control.station_m >= path.length_m() - 1e-9;
  if (!done) return gone_m;
  if (control.action != no_element) ended.push_back(control.action);
  control = {};
  return gone_m;
}

}  // namespace septet::scenario
