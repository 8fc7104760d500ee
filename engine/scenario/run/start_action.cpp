#include "engine/scenario/run/start_action.hpp"

#include <utility>

#include <fmt/format.h>

#include "engine/scenario/model/expression.hpp"
#include "engine/scenario/run/entity_motion.hpp"
#include "engine/scenario/run/keep_distance.hpp"
#include "engine/scenario/run/path_motion.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/scenario/run/speed_control.hpp"

namespace septet::scenario {
namespace {

void change_environment(const EnvironmentAction& action, ScenarioState& state) {
  Environment& environment = state.environment;
  const auto take = [](const std::optional<double>& from, double& to) { to = from.value_or(to); };
  take(action.sun_azimuth_rad, environment.sun_azimuth_rad);
  take(action.sun_elevation_rad, environment.sun_elevation_rad);
  take(action.sun_illuminance_lux, environment.sun_illuminance_lux);
  take(action.visibility_m, environment.visibility_m);
  take(action.cloud_cover, environment.cloud_cover);
  take(action.rain_mm_per_h, environment.rain_mm_per_h);
  if (action.snow_mm_per_h.value_or(0.0) > 0.0) environment.rain_mm_per_h = *action.snow_mm_per_h;
  take(action.road_wetness, environment.road_wetness);
  take(action.snow_cover, environment.snow_cover);
  take(action.friction_scale, state.friction_scale);
  take(action.temperature_k, environment.temperature_k);
  take(action.wind_speed_mps, environment.wind_speed_mps);
  take(action.wind_direction_rad, environment.wind_direction_rad);
}

void change_value(const ValueAction& action, ScenarioState& state) {
  std::string& value = state.values[action.value];
  const auto number = parse_number(value);
  if (action.kind == ValueAction::Kind::set)
    value = action.text;
  else if (number)
    value =
        fmt::format("{}", action.kind == ValueAction::Kind::add ? *number + action.number : *number * action.number);
}

/// Brings an entity into the world where it is not there.
void add_entity(const road::RoadNetwork& network, const AddEntityAction& add, ScenarioState& state,
                StepResult& result) {
  EntityState& entity = state.entities[add.entity];
  if (entity.active || entity.external) return;
  const auto placement = resolve_position(network, state, add.position);
  if (!placement) return;
  entity = {};
  place_entity(entity, *placement);
  result.teleported.push_back(add.entity);
}

/// Takes an entity out of the world, with the actions that moved it, which are added to `replaced`.
void delete_entity(EntityState& entity, std::vector<ElementIndex>& replaced) {
  if (!entity.active || entity.external) return;
  for (const auto& [active, action] : {std::pair{entity.speed_control.active, entity.speed_control.action},
                                       std::pair{entity.lateral_control.active, entity.lateral_control.action},
                                       std::pair{entity.path_control.active, entity.path_control.action}})
    if (active && action != no_element) replaced.push_back(action);
  entity = {};
}

/// Starts an action of one entity; returns whether it goes on.
struct StartPrivate {
  const Scenario& scenario;
  const road::RoadNetwork& network;
  ElementIndex action;
  EntityIndex actor;
  ScenarioState& state;
  StepResult& result;
  std::vector<ElementIndex>& replaced;

  EntityState& entity() const { return state.entities[actor]; }

  template <class Control>
  void take_over(Control& control) const {
    if (control.active && control.action != no_element) replaced.push_back(control.action);
    control = {};
  }

  bool operator()(const TeleportAction& teleport) const {
    const auto placement = resolve_position(network, state, teleport.position);
    if (!placement) return false;
    take_over(entity().lateral_control);
    take_over(entity().path_control);
    place_entity(entity(), *placement);
    result.teleported.push_back(actor);
    return false;
  }
  bool operator()(const LightStateAction& light) const {
    const std::uint16_t now = entity().lamps.bits, bits = light.lamps.bits;
    const bool off = light.mode == LightMode::off;
    entity().lamps.bits = static_cast<std::uint16_t>(off ? now & ~bits : now | bits);
    return false;
  }
  bool operator()(const SpeedAction& speed) const {
    take_over_speed();
    start_speed(scenario, state, speed, action, actor, entity());
    // A step is reached at once, unless it follows another entity without end.
    SpeedControl& control = entity().speed_control;
    control.active = control.follow != no_entity || control.transition.shape != DynamicsShape::step;
    return control.active;
  }
  bool operator()(const SpeedProfileAction& profile) const {
    take_over_speed();
    return start_speed_profile(scenario, state, profile, action, actor, entity());
  }
  bool operator()(const SynchronizeAction& synchronize) const {
    take_over_speed();
    return start_synchronization(network, state, synchronize, action, entity());
  }
  bool operator()(const KeepDistanceAction& keep) const {
    if (keep.reference == no_entity || keep.reference == actor) return false;
    const DistanceControl control{keep, side_of_reference(network, scenario, state, keep, actor)};
    if (keep.lateral) {
      if (!entity().on_road) return false;
      take_over(entity().lateral_control);
      take_over(entity().path_control);
      start_lateral_distance(control, action, entity());
    } else {
      take_over_speed();
      start_distance(control, action, entity());
    }
    return true;
  }
  bool operator()(const FollowTrajectoryAction& follow) const {
    take_over(entity().lateral_control);
    take_over(entity().path_control);
    if (follow.timed) take_over(entity().speed_control);
    return start_path(network, state, follow, action, entity());
  }
  bool operator()(const AssignRouteAction& assign) const {
    take_route(assign.route->waypoints);
    return false;
  }
  bool operator()(const AcquirePositionAction& acquire) const {
    take_route({acquire.position});
    return false;
  }
  bool operator()(const LaneChangeAction& change) const {
    take_over(entity().lateral_control);
    take_over(entity().path_control);
    return start_lane_change(network, state, change, action, entity()) && keep_lateral();
  }
  bool operator()(const LaneOffsetAction& offset) const {
    take_over(entity().lateral_control);
    take_over(entity().path_control);
    return start_lane_offset(network, state, offset, action, entity()) && keep_lateral();
  }
  /// Starts an action of no single entity.
  template <class Other>
  bool operator()(const Other&) const {
    return false;
  }

 private:
  void take_over_speed() const {
    take_over(entity().speed_control);
    if (entity().path_control.timed) take_over(entity().path_control);
  }
  void take_route(const std::vector<Position>& waypoints) const {
    if (entity().external) {
      std::vector<road::LanePosition>& places = result.guided.emplace_back();
      for (const Position& waypoint : waypoints)
        if (const auto placement = resolve_position(network, state, waypoint); placement && placement->on_road)
          places.push_back(placement->lane);
    }
    entity().route = {
        std::make_shared<const std::vector<road::RoadIndex>>(plan_from(network, state, entity(), waypoints)), 0};
  }
  bool keep_lateral() const {
    LateralControl& control = entity().lateral_control;
    control.active = control.transition.shape != DynamicsShape::step;
    return control.active;
  }
};

}  // namespace

StartedAction start_action(const Scenario& scenario, const road::RoadNetwork& network, const ActionVariant& what,
                           ElementIndex action, const std::vector<EntityIndex>& actors, ScenarioState& state,
                           StepResult& result) {
  StartedAction started;
  if (const auto* environment = std::get_if<EnvironmentAction>(&what)) {
    change_environment(*environment, state);
  } else if (const auto* swarm = std::get_if<TrafficSwarmAction>(&what)) {
    result.swarms.push_back(*swarm);
  } else if (const auto* stop = std::get_if<TrafficStopAction>(&what)) {
    result.stopped_traffic.push_back(stop->name);
  } else if (const auto* siren = std::get_if<SirenAction>(&what)) {
    state.entities[siren->entity].lamps.set(Lamp::siren, siren->on);
  } else if (const auto* value = std::get_if<ValueAction>(&what)) {
    change_value(*value, state);
  } else if (const auto* effect = std::get_if<EffectAction>(&what)) {
    result.effects.push_back(*effect);
  } else if (const auto* call = std::get_if<Call>(&what)) {
    result.calls.push_back(*call);
  } else if (const auto* rates = std::get_if<PeopleErrorRates>(&what)) {
    result.error_rates.push_back(*rates);
  } else if (const auto* people = std::get_if<PeopleWish>(&what)) {
    result.people = *people;
  } else if (const auto* overlook = std::get_if<OverlookAction>(&what)) {
    result.overlooked.push_back(*overlook);
  } else if (const auto* hazard = std::get_if<HazardAction>(&what)) {
    result.hazards.push_back({hazard->name, actors});
  } else if (const auto* add = std::get_if<AddEntityAction>(&what)) {
    add_entity(network, *add, state, result);
  } else if (const auto* gone = std::get_if<DeleteEntityAction>(&what)) {
    delete_entity(state.entities[gone->entity], started.replaced);
  }
  for (const EntityIndex actor : actors) {
    const StartPrivate start{scenario, network, action, actor, state, result, started.replaced};
    started.goes_on = std::visit(start, what) || started.goes_on;
  }
  return started;
}

}  // namespace septet::scenario
