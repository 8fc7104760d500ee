#include "engine/scenario/run/condition_evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/scenario/model/parameter_value.hpp"
#include "engine/scenario/run/entity_distance.hpp"
#include "engine/scenario/run/resolve_position.hpp"

namespace septet::scenario {
namespace {

constexpr double time_slack_s = 1e-9;

bool compare(const Comparison& comparison, double value) {
  switch (comparison.rule) {
    case Rule::equal:
      return std::abs(value - comparison.value) <= 1e-6;
    case Rule::not_equal:
      return std::abs(value - comparison.value) > 1e-6;
    case Rule::less:
      return value < comparison.value;
    case Rule::less_or_equal:
      return value <= comparison.value;
    case Rule::greater:
      return value > comparison.value;
    case Rule::greater_or_equal:
      return value >= comparison.value;
  }
  return false;
}

double component(const Vec3& world, const EntityState& entity, Direction direction) {
  if (direction == Direction::total) return glm::length(world);
  const Vec3 own = glm::conjugate(entity.world_from_entity.orientation) * world;
  if (direction == Direction::longitudinal) return own.x;
  return direction == Direction::lateral ? own.y : own.z;
}

bool in_phase(const ElementState& element, ElementPhase phase, std::uint64_t since) {
  const bool fresh = element.transition_sequence > since;
  const auto passed = [&](ElementTransition transition) { return fresh && element.last_transition == transition; };
  switch (phase) {
    case ElementPhase::standby_state:
      return element.initialised && element.status == ElementStatus::standby;
    case ElementPhase::running_state:
      return element.status == ElementStatus::running;
    case ElementPhase::complete_state:
      return element.status == ElementStatus::complete;
    case ElementPhase::start_transition:
      return passed(ElementTransition::start);
    case ElementPhase::end_transition:
      return passed(ElementTransition::end);
    case ElementPhase::stop_transition:
      return passed(ElementTransition::stop);
    case ElementPhase::skip_transition:
      return passed(ElementTransition::skip);
  }
  return false;
}

/// Tests one condition for one triggering entity (without one for conditions by value).
struct Test {
  const Scenario& scenario;
  const road::RoadNetwork& network;
  const ScenarioState& state;
  const ConditionState& condition;
  const Entity* entity = nullptr;
  const EntityState* at = nullptr;

  std::optional<Target> target(EntityIndex other) const {
    if (other >= state.entities.size() || !state.entities[other].active) return std::nullopt;
    const EntityState& found = state.entities[other];
    return Target{{found.on_road, found.lane, found.along_s, 0.0, found.world_from_entity},
                  &scenario.entities[other].box};
  }
  std::optional<Target> target(const Position& position) const {
    const auto placement = resolve_position(network, state, position);
    if (!placement) return std::nullopt;
    return Target{*placement, nullptr};
  }
  double measured(const Target& to, const DistanceMeasure& measure) const {
    return distance_m(network, *entity, *at, to, measure);
  }

  /// True where the entity's road has this lane at the entity, in its direction of travel.
  bool is_free_to_use(int lane, bool opposite_too) const {
    const auto& on = network.roads[at->lane.road];
    const auto& section = road::section_at(on, at->lane.s_m);
    if (lane == 0 || !section.has_lane(lane) || !road::is_drivable(section.lane(lane).type)) return false;
    return opposite_too || road::runs_along_s(on, section, lane) == at->along_s;
  }

  bool operator()(std::monostate) const { return false; }
  bool operator()(const SimulationTimeCondition& test) const {
    // Time is a sum of steps; equal means this step.
    const Rule rule = test.comparison.rule;
    const bool down = rule == Rule::greater || rule == Rule::less_or_equal;
    return compare(test.comparison, state.time_s + (down ? -time_slack_s : time_slack_s));
  }
  bool operator()(const ValueCondition& test) const {
    return compare_values(test.rule, state.values[test.value], test.compared);
  }
  bool operator()(const TrafficSignalCondition& test) const {
    const SignalState* now = signal_state_at(scenario.signals, test.signal, state.time_s);
    return now && now->state == test.state;
  }
  bool operator()(const TrafficSignalControllerCondition& test) const {
    if (test.controller >= scenario.signals.size()) return false;
    const PhaseNow now = phase_at(scenario.signals[test.controller], state.time_s);
    return now.phase && now.phase->name == test.phase;
  }
  bool operator()(const CollisionCondition& test) const {
    const DistanceMeasure gap{CoordinateSystem::entity, DistanceType::euclidean, true};
    for (EntityIndex other = 0; other < state.entities.size(); ++other) {
      if (&state.entities[other] == at || (test.entity != no_entity && other != test.entity)) continue;
      if (test.kind && scenario.entities[other].kind != *test.kind) continue;
      const auto to = target(other);
      if (to && measured(*to, gap) <= 0.0 && reach_as_high(scenario.entities[other].box, *to)) return true;
    }
    return false;
  }
  /// True where neither of the two is wholly above the other, as on a bridge.
  bool reach_as_high(const BoundingBox& box, const Target& to) const {
    const double apart =
        to.placement.pose.position_m.z + box.centre_m.z - at->world_from_entity.position_m.z - entity->box.centre_m.z;
    return std::abs(apart) <= 0.5 * (box.height_m + entity->box.height_m);
  }
  bool operator()(const StoryboardElementStateCondition& test) const {
    if (test.element >= state.elements.size()) return false;
    // A first evaluation sees events earlier in the same step; later ones those since the last one.
    const std::uint64_t since = condition.evaluated ? condition.sequence : state.step_sequence;
    return in_phase(state.elements[test.element], test.phase, since);
  }
  bool operator()(const EndOfRoadCondition& test) const {
    return at->at_road_end_s > 0.0 && at->at_road_end_s >= test.duration_s - time_slack_s;
  }
  bool operator()(const StandStillCondition& test) const {
    return at->standing_s > 0.0 && at->standing_s >= test.duration_s - time_slack_s;
  }
  bool operator()(const TraveledDistanceCondition& test) const { return at->travelled_m >= test.distance_m; }
  bool operator()(const ReachPositionCondition& test) const {
    const auto to = target(test.position);
    return to && glm::length(to->placement.pose.position_m - at->world_from_entity.position_m) <= test.tolerance_m;
  }
  bool operator()(const SpeedCondition& test) const {
    const double speed =
        test.direction == Direction::total ? at->speed_mps : component(at->velocity_mps, *at, test.direction);
    return compare(test.comparison, speed);
  }
  bool operator()(const AccelerationCondition& test) const {
    return compare(test.comparison, component(at->acceleration_vector_mps2, *at, test.direction));
  }
  bool operator()(const RelativeSpeedCondition& test) const {
    if (test.entity >= state.entities.size() || !state.entities[test.entity].active) return false;
    return compare(test.comparison, at->speed_mps - state.entities[test.entity].speed_mps);
  }
  bool operator()(const DistanceCondition& test) const {
    const auto to = target(test.position);
    return to && compare(test.comparison, measured(*to, test.measure));
  }
  bool operator()(const RelativeDistanceCondition& test) const {
    const auto to = target(test.entity);
    return to && compare(test.comparison, measured(*to, test.measure));
  }
  bool operator()(const TimeHeadwayCondition& test) const {
    const auto to = target(test.entity);
    // A standing entity needs an infinite time.
    const double speed = std::max(at->speed_mps, 1e-9);
    return to && compare(test.comparison, measured(*to, test.measure) / speed);
  }
  bool operator()(const RelativeClearanceCondition& test) const {
    if (!at->on_road) return false;
    const int own_lane = lane_of(network, *at);
    const auto exists = [&](const RelativeLaneRange& range) {
      for (int count = range.from; count <= range.to; ++count) {
        if (is_free_to_use(lane_beside(own_lane, at->along_s, count), test.opposite_lanes)) return true;
      }
      return false;
    };
    // Where a lane does not exist there is no room in it.
    if (!std::all_of(test.lanes.begin(), test.lanes.end(), exists)) return false;
    for (EntityIndex other = 0; other < state.entities.size(); ++other) {
      const bool counts =
          test.entities.empty() || std::find(test.entities.begin(), test.entities.end(), other) != test.entities.end();
      const EntityState& found = state.entities[other];
      if (!counts || &found == at || !found.active || !found.on_road) continue;
      if (!test.opposite_lanes && found.along_s != at->along_s) continue;
      const int lane = lane_of(network, found);
      const auto in_range = [&](const RelativeLaneRange& range) {
        for (int count = range.from; count <= range.to; ++count) {
          if (lane_beside(own_lane, at->along_s, count) == lane) return true;
        }
        return false;
      };
      if (!test.lanes.empty() && std::none_of(test.lanes.begin(), test.lanes.end(), in_range)) continue;
      const double ahead = road_distance_m(network, at->lane, at->along_s, found.lane);
      const double own = test.freespace ? (ahead > 0.0 ? entity->box.front_m() : -entity->box.rear_m()) : 0.0;
      const BoundingBox& box = scenario.entities[other].box;
      const double its = test.freespace ? (ahead > 0.0 ? -box.rear_m() : box.front_m()) : 0.0;
      const double gap = std::abs(ahead) - own - its;
      if (gap < (ahead >= 0.0 ? test.forward_m : test.backward_m)) return false;
    }
    return true;
  }
  bool operator()(const TimeToCollisionCondition& test) const {
    const auto to = test.entity != no_entity ? target(test.entity) : target(test.position);
    if (!to) return false;
    const Vec3 other = test.entity != no_entity ? state.entities[test.entity].velocity_mps : Vec3(0.0);
    const double closing = closing_speed_mps(*at, to->placement, other, test.measure);
    // An object that does not come nearer never collides.
    return closing > 1e-6 && compare(test.comparison, measured(*to, test.measure) / closing);
  }
};

bool is_by_value(const ConditionVariant& test) {
  return std::holds_alternative<SimulationTimeCondition>(test) || std::holds_alternative<ValueCondition>(test) ||
         std::holds_alternative<StoryboardElementStateCondition>(test) ||
         std::holds_alternative<TrafficSignalCondition>(test) ||
         std::holds_alternative<TrafficSignalControllerCondition>(test);
}

bool holds_now(const Scenario& scenario, const road::RoadNetwork& network, const Condition& condition,
               const ScenarioState& state) {
  Test test{scenario, network, state, state.conditions[condition.state]};
  if (is_by_value(condition.test)) return std::visit(test, condition.test);
  bool any = false, all = !condition.triggering_entities.empty();
  for (const EntityIndex entity : condition.triggering_entities) {
    test.entity = &scenario.entities[entity];
    test.at = &state.entities[entity];
    const bool holds = test.at->active && std::visit(test, condition.test);
    any = any || holds;
    all = all && holds;
  }
  return condition.all_entities ? all : any;
}

/// The first evaluation of a condition has no edge.
bool edge_of(Edge edge, const ConditionState& before, bool value) {
  if (edge == Edge::none) return value;
  if (!before.evaluated || before.last_value == value) return false;
  return edge == Edge::rising_or_falling || value == (edge == Edge::rising);
}

/// The value a delay ago; a pulse of one step is never lost between two steps.
bool delayed_value(const Condition& condition, double time_s, bool value, ConditionState& state) {
  if (condition.delay_s <= 0.0) return value;
  const bool newest = state.delayed.empty() ? state.delayed_value : state.delayed.back().value;
  if (value != newest) state.delayed.push_back({time_s, value});
  bool pulse = false;
  while (!state.delayed.empty() && state.delayed.front().time_s <= time_s - condition.delay_s + time_slack_s) {
    state.delayed_value = state.delayed.front().value;
    pulse = pulse || state.delayed_value;
    state.delayed.erase(state.delayed.begin());
  }
  return state.delayed_value || pulse;
}

}  // namespace

bool evaluate_trigger(const Scenario& scenario, const road::RoadNetwork& network, const Trigger& trigger,
                      ScenarioState& state) {
  bool holds = false;
  for (const ConditionGroup& group : trigger.groups) {
    bool all = true;
    for (const Condition& condition : group.conditions) {
      const bool value = holds_now(scenario, network, condition, state);
      ConditionState& own = state.conditions[condition.state];
      const bool edge = edge_of(condition.edge, own, value);
      all = delayed_value(condition, state.time_s, edge, own) && all;
      own.evaluated = true;
      own.last_value = value;
      own.sequence = state.sequence++;
    }
    holds = holds || all;
  }
  return holds;
}

void forget_trigger(const Trigger& trigger, ScenarioState& state) {
  for (const ConditionGroup& group : trigger.groups) {
    for (const Condition& condition : group.conditions) state.conditions[condition.state] = {};
  }
}

}  // namespace septet::scenario
