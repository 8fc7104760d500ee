#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

Comparison read_comparison(const Element& element) { return {read_rule(element), element.number("value")}; }

Direction read_direction(const Element& element) {
  return element.word<Direction>(
      "direction",
      {{"longitudinal", Direction::longitudinal}, {"lateral", Direction::lateral}, {"vertical", Direction::vertical}},
      Direction::total);
}

DistanceMeasure read_measure(const Element& element) {
  DistanceMeasure measure;
  measure.freespace = element.required_boolean("freespace", false);
  // Version 1.0 had alongRoute in place of coordinateSystem and relativeDistanceType.
  const bool along_route = element.boolean_or("alongRoute", false);
  measure.system = element.word<CoordinateSystem>("coordinateSystem",
                                                  {{"entity", CoordinateSystem::entity},
                                                   {"lane", CoordinateSystem::lane},
                                                   {"road", CoordinateSystem::road},
                                                   {"world", CoordinateSystem::world},
                                                   {"trajectory", CoordinateSystem::road}},
                                                  along_route ? CoordinateSystem::road : CoordinateSystem::entity);
  if (element.text_or("coordinateSystem", "") == "trajectory") {
    element.warning("coordinateSystem=\"trajectory\" is not supported; \"road\" is taken",
                    "measure along the road or the lane");
  }
  measure.type = element.word<DistanceType>("relativeDistanceType",
                                            {{"longitudinal", DistanceType::longitudinal},
                                             {"lateral", DistanceType::lateral},
                                             {"euclidianDistance", DistanceType::euclidean},
                                             {"cartesianDistance", DistanceType::euclidean}},
                                            along_route ? DistanceType::longitudinal : DistanceType::euclidean);
  return measure;
}

ConditionVariant read_time_to_collision(Reading& reading, const Element& found) {
  TimeToCollisionCondition condition;
  condition.measure = read_measure(found);
  condition.comparison = read_comparison(found);
  const Element target = found.required("TimeToCollisionConditionTarget");
  if (const Element entity = target.child("EntityRef")) {
    condition.entity = read_entity_reference(reading, entity);
  } else if (target) {
    condition.position = read_position(reading, target);
  }
  return condition;
}

ConditionVariant read_clearance(Reading& reading, const Element& found) {
  constexpr int furthest_lane = 100;
  RelativeClearanceCondition condition;
  condition.forward_m = found.number_or("distanceForward", 0.0, 0.0);
  condition.backward_m = found.number_or("distanceBackward", 0.0, 0.0);
  condition.freespace = found.required_boolean("freeSpace", true);
  condition.opposite_lanes = found.required_boolean("oppositeLanes", false);
  for (const Element& range : found.children("RelativeLaneRange")) {
    condition.lanes.push_back(
        {range.has("from") ? range.integer("from", -furthest_lane, furthest_lane) : -furthest_lane,
         range.has("to") ? range.integer("to", -furthest_lane, furthest_lane) : furthest_lane});
  }
  for (const Element& reference : found.children("EntityRef")) {
    const EntityIndex entity = read_entity_reference(reading, reference);
    if (entity != no_entity) condition.entities.push_back(entity);
  }
  return condition;
}

ConditionVariant read_collision(Reading& reading, const Element& found) {
  CollisionCondition condition;
  if (const Element entity = found.child("EntityRef")) {
    condition.entity = read_entity_reference(reading, entity);
  } else if (const Element kind = found.required("ByType")) {
    condition.kind = kind.word<EntityKind>("type",
                                           {{"vehicle", EntityKind::vehicle},
                                            {"pedestrian", EntityKind::pedestrian},
                                            {"miscellaneous", EntityKind::misc_object}},
                                           EntityKind::vehicle);
  }
  return condition;
}

ConditionVariant read_entity_condition(Reading& reading, const Element& element) {
  if (const Element found = element.child("EndOfRoadCondition"))
    return EndOfRoadCondition{found.number("duration", 0.0)};
  if (const Element found = element.child("CollisionCondition")) return read_collision(reading, found);
  if (const Element found = element.child("StandStillCondition"))
    return StandStillCondition{found.number("duration", 0.0)};
  if (const Element found = element.child("TraveledDistanceCondition")) {
    return TraveledDistanceCondition{found.number("value", 0.0)};
  }
  if (const Element found = element.child("ReachPositionCondition")) {
    return ReachPositionCondition{read_position(reading, found), found.number("tolerance", 0.0)};
  }
  if (const Element found = element.child("SpeedCondition")) {
    return SpeedCondition{read_comparison(found), read_direction(found)};
  }
  if (const Element found = element.child("AccelerationCondition")) {
    // Before 1.2 an acceleration had no direction: it was that of the speed.
    const bool along = reading.scenario.header.revision_minor < 2;
    return AccelerationCondition{read_comparison(found), along ? Direction::longitudinal : read_direction(found)};
  }
  if (const Element found = element.child("RelativeSpeedCondition")) {
    return RelativeSpeedCondition{read_entity_reference(reading, found), read_comparison(found)};
  }
  if (const Element found = element.child("DistanceCondition")) {
    return DistanceCondition{read_position(reading, found), read_measure(found), read_comparison(found)};
  }
  if (const Element found = element.child("RelativeDistanceCondition")) {
    return RelativeDistanceCondition{read_entity_reference(reading, found), read_measure(found),
                                     read_comparison(found)};
  }
  if (const Element found = element.child("TimeHeadwayCondition")) {
    return TimeHeadwayCondition{read_entity_reference(reading, found), read_measure(found), read_comparison(found)};
  }
  if (const Element found = element.child("RelativeClearanceCondition")) {
    return read_clearance(reading, found);
  }
  if (const Element found = element.child("TimeToCollisionCondition")) return read_time_to_collision(reading, found);
  return {};
}

ConditionVariant read_value_condition(Reading& reading, const Element& element) {
  if (const Element found = element.child("SimulationTimeCondition")) {
    return SimulationTimeCondition{read_comparison(found)};
  }
  for (const auto& [kind, reference] :
       {std::pair("ParameterCondition", "parameterRef"), std::pair("VariableCondition", "variableRef")}) {
    if (const Element found = element.child(kind)) {
      return ValueCondition{read_value_reference(reading, found, reference), read_rule(found),
                            found.text_or("value", "")};
    }
  }
  if (const Element found = element.child("TrafficSignalCondition")) {
    TrafficSignalCondition condition{found.text("name"), found.text("state")};
    const auto is_named = [&](const SignalState& state) {
      return state.signal == condition.signal && state.state == condition.state;
    };
    const bool ever = std::ranges::any_of(reading.scenario.signals, [&](const SignalController& controller) {
      return std::ranges::any_of(controller.phases,
                                 [&](const SignalPhase& phase) { return std::ranges::any_of(phase.states, is_named); });
    });
    if (!ever && !reading.names_are_elsewhere)
      found.warning(
          fmt::format("no phase has signal {} at \"{}\"; it is never true", condition.signal, condition.state),
          "name a signal and a state of the file's TrafficSignals");
    return condition;
  }
  if (const Element found = element.child("TrafficSignalControllerCondition")) {
    const std::string name = found.text("trafficSignalControllerRef");
    TrafficSignalControllerCondition condition{0, found.text("phase")};
    const auto controller = std::ranges::find(reading.scenario.signals, name, &SignalController::name);
    condition.controller = static_cast<std::size_t>(controller - reading.scenario.signals.begin());
    if (controller == reading.scenario.signals.end() && !reading.names_are_elsewhere)
      found.error(fmt::format("no traffic signal controller is named \"{}\"", name.substr(0, 60)),
                  "name one of the file's TrafficSignals");
    return condition;
  }
  if (const Element found = element.child("StoryboardElementStateCondition")) {
    StoryboardElementStateCondition condition;
    condition.element = read_element_reference(reading, found);
    condition.phase = found.required_word<ElementPhase>("state",
                                                        {{"standbyState", ElementPhase::standby_state},
                                                         {"runningState", ElementPhase::running_state},
                                                         {"completeState", ElementPhase::complete_state},
                                                         {"startTransition", ElementPhase::start_transition},
                                                         {"endTransition", ElementPhase::end_transition},
                                                         {"stopTransition", ElementPhase::stop_transition},
                                                         {"skipTransition", ElementPhase::skip_transition}},
                                                        ElementPhase::complete_state);
    return condition;
  }
  return {};
}

Condition read_condition(Reading& reading, const Element& element) {
  Condition condition;
  condition.name = element.label("name");
  condition.delay_s = element.number_or("delay", 0.0, 0.0);
  condition.edge = element.required_word<Edge>("conditionEdge",
                                               {{"none", Edge::none},
                                                {"rising", Edge::rising},
                                                {"falling", Edge::falling},
                                                {"risingOrFalling", Edge::rising_or_falling}},
                                               Edge::none);
  condition.state = reading.scenario.condition_count++;
  if (const Element by_value = element.child("ByValueCondition")) {
    condition.test = read_value_condition(reading, by_value);
  } else if (const Element by_entity = element.child("ByEntityCondition")) {
    const Element triggering = by_entity.required("TriggeringEntities");
    condition.all_entities =
        triggering && triggering.required_word<bool>("triggeringEntitiesRule", {{"any", false}, {"all", true}}, false);
    for (const Element& reference : triggering.children("EntityRef")) {
      const EntityIndex entity = read_entity_reference(reading, reference);
      if (entity != no_entity) condition.triggering_entities.push_back(entity);
    }
    condition.test = read_entity_condition(reading, by_entity.required("EntityCondition"));
  } else {
    element.error("it holds no condition", "add <ByEntityCondition> or <ByValueCondition>");
  }
  return condition;
}

}  // namespace

Rule read_rule(const Element& element) {
  return element.required_word<Rule>("rule",
                                     {{"equalTo", Rule::equal},
                                      {"notEqualTo", Rule::not_equal},
                                      {"lessThan", Rule::less},
                                      {"lessOrEqual", Rule::less_or_equal},
                                      {"greaterThan", Rule::greater},
                                      {"greaterOrEqual", Rule::greater_or_equal}},
                                     Rule::greater);
}

ElementIndex read_element_reference(Reading& reading, const Element& condition) {
  const std::string name = condition.text("storyboardElementRef");
  const std::string type = condition.text_or("storyboardElementType", "");
  if (name.empty()) return no_element;
  if (type == "storyboard") return reading.scenario.storyboard_element;
  const auto& names = reading.scenario.element_names;
  ElementIndex found = no_element;
  for (ElementIndex i = 0; i < names.size(); ++i) {
    const bool same = names[i] == name || names[i].ends_with("::" + name);
    const bool right_type = type.empty() || type == reading.element_types[i];
    if (!same || !right_type) continue;
    if (found != no_element) {
      condition.warning(fmt::format("\"{}\" may be {} or {}; the first is taken", name, names[found], names[i]),
                        "write the names of its parents before it, parted by ::");
      break;
    }
    found = i;
  }
  if (found == no_element && !reading.names_are_elsewhere) {
    condition.error(fmt::format("no {} is named \"{}\"", type.empty() ? "storyboard element" : type, name),
                    "name an element of this storyboard");
  }
  return found;
}

Trigger read_trigger(Reading& reading, const Element& trigger) {
  Trigger result;
  for (const Element& group : trigger.children("ConditionGroup")) {
    ConditionGroup conditions;
    for (const Element& condition : group.children("Condition"))
      conditions.conditions.push_back(read_condition(reading, condition));
    if (conditions.conditions.empty())
      group.error("it holds no condition", "add <Condition>");
    else
      result.groups.push_back(std::move(conditions));
  }
  return result;
}

}  // namespace septet::scenario
