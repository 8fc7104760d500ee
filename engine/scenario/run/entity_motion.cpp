#include "engine/scenario/run/entity_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "engine/core/check.hpp"
#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/scenario/run/keep_distance.hpp"
#include "engine/scenario/run/path_motion.hpp"
#include "engine/scenario/run/speed_control.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "engine/scenario/run/transition.hpp"
#include "engine/world/limbs.hpp"

namespace septet::scenario {
namespace {

constexpr double standing_mps = 1e-3;

double centre_t_m(const road::RoadNetwork& network, const road::LanePosition& lane, int of) {
  const auto& on = network.roads[lane.road];
  return road::lane_borders(on, road::section_at(on, lane.s_m), of, lane.s_m).centre_t_m();
}

/// Metres to the left in this step of an entity that keeps a distance to another.
double distance_step_m(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                       double dt_s, EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended) {
  LateralControl& control = entity.lateral_control;
  const KeepDistanceAction& what = control.distance->what;
  const auto way_m = way_to_distance_m(network, scenario, state, what, control.distance->side, who);
  if (!way_m) return 0.0;
  double step_m = *way_m;
  bool there = true;
  if (what.limits) {
    const double before = control.left_mps;
    const double goal_mps = control.left_way_m ? (*way_m - *control.left_way_m) / dt_s + before : 0.0;
    control.left_mps = next_approach_mps(*way_m, before, goal_mps, control.left_mps2, *what.limits, true, dt_s);
    control.left_mps2 = (control.left_mps - before) / dt_s;
    // Its place at the end of the step, so that the next step starts from this one's result.
    step_m = control.left_mps * dt_s;
    there = is_at_distance(*way_m, control.left_mps - goal_mps, dt_s);
  }
  control.left_way_m = *way_m;
  if (there && !what.continuous) {
    control.active = false;
    if (control.action != no_element) ended.push_back(control.action);
  }
  entity.lane.offset_m += entity.along_s ? step_m : -step_m;
  return step_m;
}

/// Metres to the left of travel by which the offset changes in this step.
double lateral_step_m(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                      double dt_s, double way_m, EntityIndex who, EntityState& entity,
                      std::vector<ElementIndex>& ended) {
  LateralControl& control = entity.lateral_control;
  if (!control.active) return 0.0;
  if (control.distance) return distance_step_m(network, scenario, state, dt_s, who, entity, ended);
  if (entity.beside_is_taken && has_yet_to_move_aside(entity)) return 0.0;
  const double before = entity.lane.offset_m;
  advance_transition(control.transition, dt_s, std::abs(way_m));
  entity.lane.offset_m = value_of(control.transition);
  if (is_done(control.transition)) {
    control.active = false;
    if (control.action != no_element) ended.push_back(control.action);
  }
  return entity.along_s ? entity.lane.offset_m - before : before - entity.lane.offset_m;
}

/// Steps into the lane at the entity's t where the target lane ends but the road continues.
bool step_into_lane_beside(const road::RoadNetwork& network, EntityState& entity, Progress& progress) {
  const auto& on = network.roads[progress.lane.road];
  const double t = lateral_t_m(network, progress.lane);
  const double s = progress.lane.s_m + (progress.along_s ? 0.01 : -0.01);
  if (s <= 0.0 || s >= on.length_m) return false;
  const int lane = road::lanes_at(on, s, t).lane_any_type;
  if (lane == 0 || lane == progress.lane.lane) return false;
  road::LanePosition beside{progress.lane.road, lane, s, 0.0};
  beside.offset_m = t - centre_t_m(network, beside, lane);
  const double shift = beside.offset_m - progress.lane.offset_m;
  entity.lateral_control.transition.from += shift;
  entity.lateral_control.transition.to += shift;
  const Progress rest = go_along(network, beside, progress.along_s, progress.left_over_m);
  progress = rest;
  return true;
}

void roll_on(const road::RoadNetwork& network, double way_m, double lateral_m, double dt_s, EntityState& entity) {
  const road::LanePoint point = road::evaluate_lane(network, entity.lane);
  const double forward_m = std::copysign(std::sqrt(std::max(0.0, way_m * way_m - lateral_m * lateral_m)), way_m);
  const double stretch = road::lane_stretch(point);
  std::span<const road::RoadIndex> route;
  if (entity.route.roads) route = std::span(*entity.route.roads).subspan(entity.route.at);
  Progress progress = go_along(network, entity.lane, entity.along_s, forward_m / stretch, route);
  if (progress.left_over_m > 0.0) step_into_lane_beside(network, entity, progress);
  const bool turned = progress.along_s != entity.along_s;
  if (turned) {
    // The next road's s runs the other way: offsets change their sign.
    Transition& transition = entity.lateral_control.transition;
    transition.from = -transition.from;
    transition.to = -transition.to;
  }
  entity.lane = progress.lane;
  entity.along_s = progress.along_s;
  const auto at = std::find(route.begin(), route.end(), entity.lane.road);
  if (at != route.end()) entity.route.at += static_cast<std::size_t>(at - route.begin());
  entity.travelled_m += std::max(0.0, std::abs(forward_m) - progress.left_over_m * stretch);
  if (progress.left_over_m > 0.0 || (entity.at_road_end_s > 0.0 && forward_m == 0.0)) {
    entity.speed_mps = 0.0;
    entity.at_road_end_s += dt_s;
  } else {
    entity.at_road_end_s = 0.0;
  }
  const double slope = forward_m != 0.0 ? lateral_m / forward_m : 0.0;
  entity.world_from_entity = lane_pose(network, entity.lane, entity.along_s, slope, entity.heading_offset_rad);
}

bool finite(const Vec3& v) { return std::isfinite(v.x + v.y + v.z); }

bool finite(const EntityState& entity) {
  const Quat& q = entity.world_from_entity.orientation;
  return std::isfinite(entity.speed_mps + entity.acceleration_mps2 + entity.travelled_m + entity.lane.s_m +
                       entity.lane.offset_m + entity.wheel_angle_rad + q.w + q.x + q.y + q.z) &&
         finite(entity.world_from_entity.position_m) && finite(entity.velocity_mps) &&
         finite(entity.acceleration_vector_mps2) && finite(entity.angular_velocity_radps);
}

/// State of an entity whose numbers went bad: its place, if that is finite, and no motion.
EntityState halted(const EntityState& before) {
  EntityState result;
  result.active = finite(before.world_from_entity.position_m);
  result.on_road = before.on_road && std::isfinite(before.lane.s_m + before.lane.offset_m);
  if (result.on_road) result.lane = before.lane;
  result.along_s = before.along_s;
  result.heading_offset_rad = before.heading_offset_rad;
  result.lamps = before.lamps;
  if (result.active) result.world_from_entity = before.world_from_entity;
  return result;
}

}  // namespace

void place_entity(EntityState& entity, const Placement& placement) {
  entity.active = true;
  entity.on_road = placement.on_road;
  entity.lane = placement.lane;
  entity.along_s = placement.along_s;
  entity.heading_offset_rad = placement.heading_offset_rad;
  entity.world_from_entity = placement.pose;
  entity.velocity_mps = placement.pose.orientation * Vec3(entity.speed_mps, 0.0, 0.0);
  entity.angular_velocity_radps = entity.acceleration_vector_mps2 = Vec3(0.0);
  entity.at_road_end_s = 0.0;
}

bool start_lane_change(const road::RoadNetwork& network, const ScenarioState& state, const LaneChangeAction& what,
                       ElementIndex action, EntityState& entity) {
  if (!entity.on_road) return false;
  int lane = what.lane;
  if (what.reference != no_entity) {
    const EntityState& reference = state.entities[what.reference];
    if (!reference.active || !reference.on_road) return false;
    lane = lane_beside(lane_of(network, reference), reference.along_s, what.lane);
  }
  const auto& section = road::section_at(network.roads[entity.lane.road], entity.lane.s_m);
  if (lane == 0 || !section.has_lane(lane)) return false;
  const double side = entity.along_s ? 1.0 : -1.0;
  const double from = lateral_t_m(network, entity.lane) - centre_t_m(network, entity.lane, lane);
  entity.lane.lane = lane;
  entity.lane.offset_m = from;
  LateralControl control;
  control.active = true;
  control.action = action;
  control.transition = offset_transition(what.dynamics, from, side * what.target_offset_m);
  control.lane_change = true;
  control.to_the_left = side * (control.transition.to - from) > 0.0;
  if (is_done(control.transition)) entity.lane.offset_m = control.transition.to;
  entity.lateral_control = control;
  return true;
}

void start_lateral_distance(const DistanceControl& distance, ElementIndex action, EntityState& entity) {
  LateralControl control;
  control.active = true;
  control.action = action;
  control.distance = std::make_shared<const DistanceControl>(distance);
  entity.lateral_control = control;
}

bool start_lane_offset(const road::RoadNetwork& network, const ScenarioState& state, const LaneOffsetAction& what,
                       ElementIndex action, EntityState& entity) {
  if (!entity.on_road) return false;
  const double side = entity.along_s ? 1.0 : -1.0;
  double to = side * what.offset_m;
  if (what.reference != no_entity) {
    const EntityState& reference = state.entities[what.reference];
    if (!reference.active || !reference.on_road) return false;
    to += lateral_t_m(network, reference.lane) - centre_t_m(network, entity.lane, entity.lane.lane);
  }
  LateralControl control;
  control.active = true;
  control.action = action;
  const bool bounded = what.max_lateral_acceleration_mps2 && *what.max_lateral_acceleration_mps2 > 0.0;
  control.transition =
      bounded ? bounded_offset_transition(what.shape, *what.max_lateral_acceleration_mps2, entity.lane.offset_m, to)
              : Transition{DynamicsShape::step, false, 0.0, 0.0, entity.lane.offset_m, to};
  if (is_done(control.transition)) entity.lane.offset_m = to;
  entity.lateral_control = control;
  return true;
}

bool move_entity(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state, double dt_s,
                 EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended) {
  const EntityState at_start = entity;
  // No road look-up below may see NaN.
  const auto reset = [&] {
    for (const ElementIndex action :
         {at_start.speed_control.action, at_start.lateral_control.action, at_start.path_control.action})
      if (action != no_element && std::find(ended.begin(), ended.end(), action) == ended.end()) ended.push_back(action);
    entity = halted(at_start);
    return false;
  };
  if (!finite(entity)) return reset();
  const double speed_before = entity.speed_mps;
  const RigidTransform before = entity.world_from_entity;
  const bool on_path = entity.path_control.active;
  SpeedStep step{speed_before, 0.0};
  if (!on_path || !entity.path_control.timed) step = next_speed(network, scenario, state, dt_s, who, entity, ended);
  if (!std::isfinite(step.speed_mps + step.jump_m)) return reset();
  entity.speed_mps = step.speed_mps;
  double way_m = 0.5 * (speed_before + entity.speed_mps) * dt_s + step.jump_m;
  if (on_path) {
    way_m = follow_path(network, way_m, dt_s, entity, ended);
  } else if (entity.on_road) {
    const double lateral_m = lateral_step_m(network, scenario, state, dt_s, way_m, who, entity, ended);
    if (!std::isfinite(lateral_m)) return reset();
    roll_on(network, way_m, lateral_m, dt_s, entity);
  } else {
    entity.world_from_entity.position_m += before.orientation * Vec3(way_m, 0.0, 0.0);
    entity.travelled_m += std::abs(way_m);
  }
  entity.standing_s = std::abs(entity.speed_mps) < standing_mps ? entity.standing_s + dt_s : 0.0;
  entity.acceleration_mps2 = (entity.speed_mps - speed_before) / dt_s;

  const Quat& orientation = entity.world_from_entity.orientation;
  const Quat turn = orientation * glm::conjugate(before.orientation);
  const double sign = turn.w < 0.0 ? -1.0 : 1.0;
  // For the small turn of one step, twice the vector part is the rotation vector.
  entity.angular_velocity_radps = sign * 2.0 / dt_s * Vec3(turn.x, turn.y, turn.z);
  // An entity askew in its lane goes along it all the same.
  const bool askew = entity.on_road && !on_path && entity.heading_offset_rad != 0.0;
  const Quat travel =
      askew ? orientation * glm::angleAxis(-entity.heading_offset_rad, Vec3(0.0, 0.0, 1.0)) : orientation;
  entity.velocity_mps = travel * Vec3(entity.speed_mps, 0.0, 0.0);
  entity.acceleration_vector_mps2 = travel * Vec3(entity.acceleration_mps2, 0.0, 0.0) +
                                    glm::cross(entity.angular_velocity_radps, entity.velocity_mps);
  const double radius = std::max(0.1, 0.5 * scenario.entities[who].front_axle.wheel_diameter_m);
  entity.wheel_angle_rad = std::fmod(entity.wheel_angle_rad + way_m / radius, 2.0 * std::numbers::pi);
  if (entity.wheel_angle_rad < 0.0) entity.wheel_angle_rad += 2.0 * std::numbers::pi;
  if (scenario.entities[who].kind == EntityKind::pedestrian)
    entity.strides = std::fmod(entity.strides + dt_s * strides_hz(way_m / dt_s), 1.0);
  return finite(entity) || reset();
}

void mind_the_way(EntityIndex index, std::optional<InTheWay> in_the_way, bool beside_is_taken, ScenarioState& state) {
  SEPTET_CHECK(index < state.entities.size(), "entity {} of {}", index, state.entities.size());
  state.entities[index].in_the_way = in_the_way;
  state.entities[index].beside_is_taken = beside_is_taken;
}

bool has_yet_to_move_aside(const EntityState& entity) {
  constexpr double begun_m = 0.02;
  const LateralControl& control = entity.lateral_control;
  return control.active && !control.distance && !is_done(control.transition) &&
         std::abs(entity.lane.offset_m - control.transition.from) < begun_m;
}

void place_external(const road::RoadNetwork& network, EntityIndex index, const RigidTransform& world_from_entity,
                    const Vec3& velocity_mps, const Vec3& acceleration_mps2, ScenarioState& state) {
  SEPTET_CHECK(index < state.entities.size(), "entity {} of {}", index, state.entities.size());
  EntityState& entity = state.entities[index];
  const Vec3 forward = world_from_entity.orientation * Vec3(1.0, 0.0, 0.0);
  entity.travelled_m +=
      entity.active ? glm::length(world_from_entity.position_m - entity.world_from_entity.position_m) : 0.0;
  entity.active = true;
  entity.world_from_entity = world_from_entity;
  entity.velocity_mps = velocity_mps;
  entity.acceleration_vector_mps2 = acceleration_mps2;
  entity.speed_mps = glm::dot(velocity_mps, forward);
  entity.acceleration_mps2 = glm::dot(acceleration_mps2, forward);

  const road::RoadPosition hint{entity.lane.road, entity.lane.s_m, 0.0};
  const auto found = road::locate(network, Vec2(world_from_entity.position_m), entity.on_road ? &hint : nullptr);
  entity.on_road = found && found->lanes.lane_any_type != 0;
  if (!entity.on_road) return;
  const int lane = found->lanes.lane_any_type;
  entity.lane = {found->position.road, lane, found->position.s_m, 0.0};
  entity.lane.offset_m = found->position.t_m - lateral_t_m(network, entity.lane);
  const double turn = heading_rad(world_from_entity.orientation) - road::evaluate(network, found->position).heading_rad;
  entity.along_s = std::cos(turn) >= 0.0;
}

}  // namespace septet::scenario
