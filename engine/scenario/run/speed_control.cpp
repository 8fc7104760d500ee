#include "engine/scenario/run/speed_control.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/scenario/run/keep_distance.hpp"
#include "engine/scenario/run/speed_profile.hpp"
#include "engine/scenario/run/synchronize.hpp"
#include "engine/scenario/run/transition.hpp"

namespace septet::scenario {
namespace {

void end(SpeedControl& control, std::vector<ElementIndex>& ended) {
  control.active = false;
  if (control.action != no_element) ended.push_back(control.action);
}

SpeedControl begun(ElementIndex action) {
  SpeedControl control;
  control.active = true;
  control.action = action;
  return control;
}

/// From here on the control sets the entity's speed, without a deficit of an earlier one.
void take_over(SpeedControl control, EntityState& entity) {
  entity.speed_control = std::move(control);
  entity.held_back_mps = 0.0;
}

/// The action's own bounds, and the vehicle's where it has none.
DynamicConstraints bounds(const std::optional<DynamicConstraints>& limits, const Performance& vehicle) {
  DynamicConstraints result = limits.value_or(DynamicConstraints{});
  const auto fill = [](double& bound, double other) {
    if (!std::isfinite(bound)) bound = other;
  };
  fill(result.max_speed_mps, vehicle.max_speed_mps);
  fill(result.max_acceleration_mps2, vehicle.max_acceleration_mps2);
  fill(result.max_deceleration_mps2, vehicle.max_deceleration_mps2);
  return result;
}

SpeedStep profile_step(const ScenarioState& state, double dt_s, EntityState& entity, std::vector<ElementIndex>& ended) {
  SpeedControl& control = entity.speed_control;
  control.profile_s += dt_s;
  const double base = control.follow != no_entity ? state.entities[control.follow].speed_mps : 0.0;
  const double speed = base + speed_at(*control.profile, control.profile_s);
  if (control.profile_s >= control.profile->end_s - 1e-9) end(control, ended);
  return {speed, 0.0};
}

SpeedStep distance_step(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                        double dt_s, EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended) {
  SpeedControl& control = entity.speed_control;
  const KeepDistanceAction& what = control.distance->what;
  auto way_m = way_to_distance_m(network, scenario, state, what, control.distance->side, who);
  if (!way_m) return {entity.speed_mps, 0.0};
  const EntityState& reference = state.entities[what.reference];
  const Vec3 ahead(1.0, 0.0, 0.0);
  const bool same_way =
      glm::dot(reference.world_from_entity.orientation * ahead, entity.world_from_entity.orientation * ahead) >= 0.0;
  const double goal_mps = same_way ? reference.speed_mps : -reference.speed_mps;
  // Entities before it in the list are at the end of this step already.
  if (what.reference < who && !reference.external) *way_m -= goal_mps * dt_s;
  if (!what.limits) {
    const double speed = std::max(0.0, goal_mps);
    if (!what.continuous) end(control, ended);
    return {speed, *way_m + goal_mps * dt_s - 0.5 * (entity.speed_mps + speed) * dt_s};
  }
  const double speed = next_approach_mps(*way_m, entity.speed_mps, goal_mps, entity.acceleration_mps2,
                                         bounds(what.limits, scenario.entities[who].performance), false, dt_s);
  if (!what.continuous && is_at_distance(*way_m, speed - goal_mps, dt_s)) end(control, ended);
  return {speed, 0.0};
}

SpeedStep meeting_step(const road::RoadNetwork& network, const ScenarioState& state, const Performance& vehicle,
                       double dt_s, EntityState& entity, std::vector<ElementIndex>& ended) {
  SpeedControl& control = entity.speed_control;
  const auto left = left_of(network, state, *control.meeting, entity, dt_s);
  // An entity that has arrived has its final speed, so that a condition can test for equality.
  const double wanted = left ? next_meeting_mps(*left, entity.speed_mps, dt_s)
                             : final_mps(*control.meeting, state).value_or(entity.speed_mps);
  if (!left) end(control, ended);
  const double low = entity.speed_mps - vehicle.max_deceleration_mps2 * dt_s;
  const double high = entity.speed_mps + vehicle.max_acceleration_mps2 * dt_s;
  return {std::min(std::clamp(wanted, low, high), vehicle.max_speed_mps), 0.0};
}

double followed_speed_mps(const SpeedControl& control, const ScenarioState& state) {
  return control.follow_factor * state.entities[control.follow].speed_mps + control.follow_delta_mps;
}

double transition_step(const ScenarioState& state, const Performance& limits, double dt_s, EntityState& entity,
                       std::vector<ElementIndex>& ended) {
  SpeedControl& control = entity.speed_control;
  double speed = entity.speed_mps + entity.held_back_mps;
  if (control.follow != no_entity && state.entities[control.follow].active) {
    speed = followed_speed_mps(control, state);
    if (control.transition.shape != DynamicsShape::step) {
      const double most =
          (speed > entity.speed_mps ? limits.max_acceleration_mps2 : limits.max_deceleration_mps2) * dt_s;
      speed = std::clamp(speed, entity.speed_mps - most, entity.speed_mps + most);
    }
  } else {
    advance_transition(control.transition, dt_s, std::abs(entity.speed_mps) * dt_s);
    speed = value_of(control.transition);
    if (is_done(control.transition)) end(control, ended);
  }
  return std::clamp(speed, -limits.max_speed_mps, limits.max_speed_mps);
}

/// Highest speed at which it can still stop behind the obstacle, or follow it.
double fastest_behind_mps(const InTheWay& other) {
  constexpr double standing_gap_m = 3.0, braking_mps2 = 4.0;
  const double other_mps = std::max(0.0, other.speed_mps), spare_m = other.gap_m - standing_gap_m;
  if (spare_m < 0.0) return other_mps * std::max(0.0, other.gap_m) / standing_gap_m;
  return std::sqrt(other_mps * other_mps + 2.0 * braking_mps2 * spare_m);
}

/// One step of the script.
SpeedStep scripted_step(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                        double dt_s, EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended) {
  const SpeedControl& control = entity.speed_control;
  if (!control.active) return {entity.speed_mps + entity.held_back_mps, 0.0};
  if (control.profile) return profile_step(state, dt_s, entity, ended);
  if (control.distance) return distance_step(network, scenario, state, dt_s, who, entity, ended);
  const Performance& vehicle = scenario.entities[who].performance;
  if (control.meeting) return meeting_step(network, state, vehicle, dt_s, entity, ended);
  return {transition_step(state, vehicle, dt_s, entity, ended), 0.0};
}

}  // namespace

void start_speed(const Scenario& scenario, const ScenarioState& state, const SpeedAction& what, ElementIndex action,
                 EntityIndex who, EntityState& entity) {
  SpeedControl control = begun(action);
  double target = what.value;
  if (what.reference != no_entity) {
    const double reference = state.entities[what.reference].speed_mps;
    control.follow_factor = what.factor ? what.value : 1.0;
    control.follow_delta_mps = what.factor ? 0.0 : what.value;
    target = control.follow_factor * reference + control.follow_delta_mps;
    if (what.continuous) control.follow = what.reference;
  }
  const Performance& limits = scenario.entities[who].performance;
  target = std::clamp(target, -limits.max_speed_mps, limits.max_speed_mps);
  const double strongest = target > entity.speed_mps ? limits.max_acceleration_mps2 : limits.max_deceleration_mps2;
  control.transition = speed_transition(what.dynamics, entity.speed_mps, target, strongest);
  if (control.transition.shape == DynamicsShape::step) entity.speed_mps = target;
  take_over(std::move(control), entity);
}

bool start_speed_profile(const Scenario& scenario, const ScenarioState& state, const SpeedProfileAction& what,
                         ElementIndex action, EntityIndex who, EntityState& entity) {
  const double base = what.reference != no_entity ? state.entities[what.reference].speed_mps : 0.0;
  SpeedProfile profile =
      lay_speed_profile(what, entity.speed_mps - base, bounds(what.limits, scenario.entities[who].performance));
  SpeedControl control = begun(action);
  control.active = profile.end_s > 0.0;
  control.follow = what.reference;
  if (!control.active) entity.speed_mps = base + profile.end_mps;
  control.profile = std::make_shared<const SpeedProfile>(std::move(profile));
  take_over(std::move(control), entity);
  return entity.speed_control.active;
}

void start_distance(const DistanceControl& distance, ElementIndex action, EntityState& entity) {
  SpeedControl control = begun(action);
  control.distance = std::make_shared<const DistanceControl>(distance);
  take_over(std::move(control), entity);
}

bool start_synchronization(const road::RoadNetwork& network, const ScenarioState& state, const SynchronizeAction& what,
                           ElementIndex action, EntityState& entity) {
  if (what.master == no_entity) return false;
  auto meeting = plan_meeting(network, state, what);
  if (!meeting) return false;
  SpeedControl control = begun(action);
  control.meeting = std::make_shared<const Meeting>(std::move(*meeting));
  take_over(std::move(control), entity);
  return true;
}

SpeedStep next_speed(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                     double dt_s, EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended) {
  constexpr double regained_mps2 = 1.5, hardest_braking_mps2 = 9.0;
  const double before = entity.speed_mps;
  const double strongest = std::min(scenario.entities[who].performance.max_deceleration_mps2, hardest_braking_mps2);
  const SpeedStep scripted = scripted_step(network, scenario, state, dt_s, who, entity, ended);
  SpeedStep step = scripted;
  if (entity.held_back_mps > 0.0) step.speed_mps = std::min(step.speed_mps, before + regained_mps2 * dt_s);
  if (entity.in_the_way) {
    step.speed_mps =
        std::min(step.speed_mps, std::max(fastest_behind_mps(*entity.in_the_way), before - strongest * dt_s));
  }
  entity.held_back_mps = std::max(0.0, scripted.speed_mps - step.speed_mps);
  return step;
}

}  // namespace septet::scenario
