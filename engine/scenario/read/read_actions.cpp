#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "engine/core/printable.hpp"
#include "engine/scenario/model/misc_object.hpp"
#include "engine/scenario/read/scenario_reading.hpp"
#include "engine/world/people.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/scene_call.hpp"

namespace septet::scenario {
namespace {

DynamicsShape read_shape(const Element& element) {
  return element.required_word<DynamicsShape>("dynamicsShape",
                                              {{"step", DynamicsShape::step},
                                               {"linear", DynamicsShape::linear},
                                               {"sinusoidal", DynamicsShape::sinusoidal},
                                               {"cubic", DynamicsShape::cubic}},
                                              DynamicsShape::step);
}

ActionVariant read_speed(Reading& reading, const Element& element) {
  SpeedAction action;
  action.dynamics = read_dynamics(element.required("SpeedActionDynamics"));
  const Element target = element.required("SpeedActionTarget");
  if (const Element absolute = target.child("AbsoluteTargetSpeed")) {
    action.value = absolute.number("value", -most_mps, most_mps);
  } else if (const Element relative = target.child("RelativeTargetSpeed")) {
    action.reference = read_entity_reference(reading, relative);
    action.value = relative.number("value", -most_mps, most_mps);
    action.factor = relative.required_word<bool>("speedTargetValueType", {{"factor", true}, {"delta", false}}, false);
    action.continuous = relative.required_boolean("continuous", false);
  } else {
    target.error("it has no target speed", "add <AbsoluteTargetSpeed> or <RelativeTargetSpeed>");
  }
  return action;
}

ActionVariant read_lane_change(Reading& reading, const Element& element) {
  LaneChangeAction action;
  action.dynamics = read_dynamics(element.required("LaneChangeActionDynamics"));
  action.target_offset_m = element.number_or("targetLaneOffset", 0.0);
  const Element target = element.required("LaneChangeTarget");
  if (const Element absolute = target.child("AbsoluteTargetLane")) {
    action.lane = absolute.integer("value", -most_lanes, most_lanes);
  } else if (const Element relative = target.child("RelativeTargetLane")) {
    action.reference = read_entity_reference(reading, relative);
    action.lane = relative.integer("value", -most_lanes, most_lanes);
  } else {
    target.error("it has no target lane", "add <AbsoluteTargetLane> or <RelativeTargetLane>");
  }
  return action;
}

ActionVariant read_lane_offset(Reading& reading, const Element& element) {
  LaneOffsetAction action;
  action.continuous = element.required_boolean("continuous", false);
  const Element dynamics = element.required("LaneOffsetActionDynamics");
  action.shape = read_shape(dynamics);
  action.max_lateral_acceleration_mps2 = dynamics.optional_number("maxLateralAcc");
  const Element target = element.required("LaneOffsetTarget");
  if (const Element absolute = target.child("AbsoluteTargetLaneOffset")) {
    action.offset_m = absolute.number("value");
  } else if (const Element relative = target.child("RelativeTargetLaneOffset")) {
    action.reference = read_entity_reference(reading, relative);
    action.offset_m = relative.number("value");
  } else {
    target.error("it has no target offset", "add <AbsoluteTargetLaneOffset> or <RelativeTargetLaneOffset>");
  }
  return action;
}

Lamps lamps_of(std::initializer_list<Lamp> lamps) {
  Lamps result;
  for (const Lamp lamp : lamps) result.set(lamp, true);
  return result;
}

ActionVariant read_light(const Element& element) {
  LightStateAction action;
  const Element light = element.required("LightType").child("VehicleLight");
  const Element state = element.required("LightState");
  action.mode = state.required_word<LightMode>(
      "mode", {{"off", LightMode::off}, {"on", LightMode::on}, {"flashing", LightMode::flashing}}, LightMode::off);
  if (!light) return std::monostate{};
  action.lamps = light.word<Lamps>("vehicleLightType",
                                   {{"daytimeRunningLights", Lamps{}},
                                    {"lowBeam", lamps_of({Lamp::low_beam})},
                                    {"highBeam", lamps_of({Lamp::high_beam})},
                                    {"fogLights", lamps_of({Lamp::rear_fog})},
                                    {"fogLightsRear", lamps_of({Lamp::rear_fog})},
                                    {"brakeLights", lamps_of({Lamp::brake})},
                                    {"warningLights", lamps_of({Lamp::indicator_left, Lamp::indicator_right})},
                                    {"indicatorLeft", lamps_of({Lamp::indicator_left})},
                                    {"indicatorRight", lamps_of({Lamp::indicator_right})},
                                    {"reversingLights", lamps_of({Lamp::reverse})},
                                    {"specialPurposeLights", lamps_of({Lamp::beacon})},
                                    {"fogLightsFront", Lamps{}},
                                    {"licensePlateIllumination", Lamps{}}},
                                   Lamps{});
  if (action.lamps == Lamps{}) light.warning("no vehicle of Septet has this lamp", "expect no effect");
  return action;
}

}  // namespace

TransitionDynamics read_dynamics(const Element& element) {
  TransitionDynamics dynamics;
  dynamics.shape = read_shape(element);
  dynamics.dimension = element.required_word<DynamicsDimension>(
      "dynamicsDimension",
      {{"time", DynamicsDimension::time}, {"distance", DynamicsDimension::distance}, {"rate", DynamicsDimension::rate}},
      DynamicsDimension::time);
  // Older files write a braking rate with its sign; the direction follows from the target.
  dynamics.value = std::abs(element.number("value"));
  constexpr double least = 1e-6;  // Least value in seconds, metres or either's rate: smaller ones are meant as 0.
  if (dynamics.value > 0.0 && dynamics.value < least) {
    element.warning(fmt::format("value=\"{}\" is as good as 0", dynamics.value),
                    "write 0, or a value that can be told from it");
  }
  if (element.word<bool>("followingMode", {{"position", false}, {"follow", true}}, false)) {
    element.warning("followingMode=\"follow\" is not supported; \"position\" is taken",
                    "expect the target to be met exactly");
  }
  return dynamics;
}

ActionVariant read_private_action(Reading& reading, const Element& action) {
  if (const Element longitudinal = action.child("LongitudinalAction")) {
    if (const Element found = longitudinal.child("SpeedAction")) return read_speed(reading, found);
    if (const Element found = longitudinal.child("SpeedProfileAction")) return read_speed_profile(reading, found);
    if (const Element found = longitudinal.child("LongitudinalDistanceAction"))
      return read_longitudinal_distance(reading, found);
    return {};
  }
  if (const Element lateral = action.child("LateralAction")) {
    if (const Element found = lateral.child("LaneChangeAction")) return read_lane_change(reading, found);
    if (const Element found = lateral.child("LaneOffsetAction")) return read_lane_offset(reading, found);
    if (const Element found = lateral.child("LateralDistanceAction")) return read_lateral_distance(reading, found);
    return {};
  }
  if (const Element found = action.child("TeleportAction")) return TeleportAction{read_position(reading, found)};
  if (const Element found = action.child("SynchronizeAction")) return read_synchronize(reading, found);
  // Marked as read, so that its parts are reported, not itself.
  if (const Element routing = action.child("RoutingAction")) {
    if (const Element found = routing.child("FollowTrajectoryAction")) return read_follow_trajectory(reading, found);
    if (const Element found = routing.child("AssignRouteAction"))
      return AssignRouteAction{read_route_in(reading, found)};
    if (const Element found = routing.child("AcquirePositionAction"))
      return AcquirePositionAction{read_position(reading, found)};
  }
  action.child("ControllerAction");
  if (const Element appearance = action.child("AppearanceAction")) {
    if (const Element found = appearance.child("LightStateAction")) return read_light(found);
  }
  return {};
}

namespace {

ActionVariant read_value_action(Reading& reading, const Element& element, const char* reference) {
  ValueAction action;
  action.value = read_value_reference(reading, element, reference);
  const Element rule = element.child("ModifyAction").child("Rule");
  if (const Element set = element.child("SetAction")) {
    action.text = set.text_or("value", "");
  } else if (const Element added = rule.child("AddValue")) {
    action.kind = ValueAction::Kind::add;
    action.number = added.number("value");
  } else if (const Element factor = rule.child("MultiplyByValue")) {
    action.kind = ValueAction::Kind::multiply;
    action.number = factor.number("value");
  } else {
    element.error("it changes nothing", "add <SetAction> or <ModifyAction>");
  }
  return action;
}

ActionVariant read_entity_action(Reading& reading, const Element& element) {
  const EntityIndex entity = read_entity_reference(reading, element);
  const Element add = element.child("AddEntityAction"), gone = element.child("DeleteEntityAction");
  if (!add && !gone) element.error("it does nothing", "add <AddEntityAction> or <DeleteEntityAction>");
  ActionVariant action;
  if (add) {
    AddEntityAction added{entity, read_position(reading, add)};
    if (entity != no_entity && object_form(reading.scenario.entities[entity]) == ObjectForm::breakable)
      add.warning("what can break comes into the world as the drive begins, or not at all",
                  "give it a TeleportAction in <Init>");
    if (entity != no_entity) action = std::move(added);
  } else if (gone && entity != no_entity) {
    action = DeleteEntityAction{entity};
  }
  return action;
}

}  // namespace

ActionVariant read_global_action(Reading& reading, const Element& action) {
  if (const Element found = action.child("ParameterAction")) return read_value_action(reading, found, "parameterRef");
  if (const Element found = action.child("VariableAction")) return read_value_action(reading, found, "variableRef");
  if (const Element found = action.child("EnvironmentAction")) return read_environment_action(reading, found);
  if (const Element traffic = action.child("TrafficAction")) {
    const std::string name = traffic.text_or("trafficName", "");
    if (const Element found = traffic.child("TrafficSwarmAction")) {
      TrafficSwarmAction swarm = read_traffic_swarm(reading, found);
      swarm.name = name;
      return swarm;
    }
    if (traffic.child("TrafficStopAction")) return TrafficStopAction{name};
  }
  if (const Element entity = action.child("EntityAction")) return read_entity_action(reading, entity);
  return {};
}

namespace {

/// An entity's name, which may hold spaces, and the words after it.
struct Command {
  EntityIndex entity = no_entity;
  std::vector<std::string> words;
};
Command split_command(const Reading& reading, const std::string& content) {
  Command command;
  std::string name = content;
  while (!name.empty()) {
    if (const auto found = find_entity(reading.scenario, name)) {
      command.entity = *found;
      break;
    }
    const auto space = name.rfind(' ');
    if (space == std::string::npos) break;
    command.words.insert(command.words.begin(), name.substr(space + 1));
    name.resize(space);
  }
  return command;
}

ActionVariant read_effect_command(Reading& reading, const Element& element, EffectAction::Kind kind) {
  const Command command = split_command(reading, element.content());
  EffectAction effect;
  effect.kind = kind;
  effect.entity = command.entity;
  bool good = effect.entity != no_entity;
  if (kind == EffectAction::Kind::spill) {
    const std::size_t count = command.words.size();
    good = good && (count == 1 || count == 4 || count == 5);
    if (good) effect.part = command.words.front();
    double* numbers[] = {&effect.x_m, &effect.y_m, &effect.slide_mps, &effect.side_mps};
    for (std::size_t i = 1; good && i < command.words.size(); ++i) {
      char* end = nullptr;
      *numbers[i - 1] = std::strtod(command.words[i].c_str(), &end);
      good = end && *end == 0 && std::abs(*numbers[i - 1]) < 100.0;
    }
  } else {
    good = good && command.words.empty();
  }
  if (good) return effect;
  element.error("its content names no entity, or is incomplete",
                kind == EffectAction::Kind::spill
                    ? "write an entity's name, a part, and perhaps x, y (m) and one or two speeds (m/s)"
                    : "write an entity's name");
  return {};
}

/// "ENTITY LENGTH MM": the lane of an entity, from it on ahead.
ActionVariant read_black_ice_before(const Reading& reading, const Element& element) {
  const Command command = split_command(reading, element.content());
  double length_m = 0.0, thickness_mm = 0.0;
  constexpr double longest_m = 255.0, thickest_mm = 1000.0;
  const auto number = [](const std::string& word, double& value) {
    char* end = nullptr;
    value = std::strtod(word.c_str(), &end);
    return end && *end == 0 && value > 0.0;
  };
  if (command.words.size() != 2 || !number(command.words[0], length_m) || !number(command.words[1], thickness_mm) ||
      length_m > longest_m || thickness_mm >= thickest_mm) {
    element.error("its content names no stretch of a lane, or is out of bounds",
                  "behind the entity's name write a length (m, at most 255) and a thickness (mm)");
    return {};
  }
  EffectAction effect;
  effect.kind = EffectAction::Kind::freeze;
  effect.entity = command.entity;
  effect.length_m = length_m;
  effect.thickness_m = thickness_mm / 1000.0;
  return effect;
}

/// The last words are numbers, those before them the road's id.
ActionVariant read_black_ice(const Reading& reading, const Element& element) {
  if (reading.names_are_elsewhere) return {};
  if (split_command(reading, element.content()).entity != no_entity) return read_black_ice_before(reading, element);
  constexpr std::size_t count = 4;
  constexpr double most_mm = 1000.0;
  std::string id = element.content();
  std::array<double, count> numbers{};
  bool good = true;
  for (std::size_t i = count; i-- > 0 && good;) {
    const auto space = id.rfind(' ');
    good = space != std::string::npos && space + 1 < id.size();
    if (!good) break;
    char* end = nullptr;
    numbers[i] = std::strtod(id.c_str() + space + 1, &end);
    good = *end == 0 && std::abs(numbers[i]) < 1e6;
    id.resize(space);
  }
  const auto [lane, s_m, length_m, thickness_mm] = numbers;
  good = good && !id.empty() && lane != 0.0 && lane == std::trunc(lane) && s_m >= 0.0 && length_m > 0.0 &&
         length_m <= 255.0 && thickness_mm > 0.0 && thickness_mm < most_mm;
  if (!good) {
    element.error("its content names no stretch of a lane, or is out of bounds",
                  "write a road's id, a lane, a station (m), a length (m, at most 255) and a thickness (mm)");
    return {};
  }
  EffectAction effect;
  effect.kind = EffectAction::Kind::freeze;
  effect.road = std::move(id);
  effect.lane = static_cast<int>(lane);
  effect.s_m = s_m;
  effect.length_m = length_m;
  effect.thickness_m = thickness_mm / 1000.0;
  return effect;
}

ActionVariant read_call_command(const Element& element) {
  auto call = read_call(element.content());
  if (!call) {
    element.error(call.error().what, call.error().remedy);
    return {};
  }
  call->by = storyboard_calls;
  return std::move(*call);
}

ActionVariant read_scene_command(const Element& element) {
  Call call = scene_call_of(element.content());
  if (!call.parameters.front().second.empty() && read_call(text_of(call))) return call;
  element.error(fmt::format("its content is no line of at most {} bytes", longest_call_value),
                "write a command of a node: hide-set \"town house/1/2\" 1");
  return {};
}

ActionVariant read_errors_command(const Element& element) {
  const auto rates = read_error_rates(element.content());
  if (rates) return *rates;
  element.error(rates.error().what, rates.error().remedy);
  return {};
}

ActionVariant read_people_command(const Element& element) {
  const auto wish = read_people_wish(element.content_with_parameters());
  if (wish) return *wish;
  element.error(wish.error().what, wish.error().remedy);
  return {};
}

ActionVariant read_overlook_command(const Reading& reading, const Element& element) {
  const auto wish = read_overlook_wish(element.content());
  if (!wish) {
    element.error(wish.error().what, wish.error().remedy);
    return {};
  }
  OverlookAction overlook{wish->who, no_entity};
  if (wish->whom.empty()) return overlook;
  if (const auto whom = find_entity(reading.scenario, wish->whom)) {
    overlook.whom = *whom;
    return overlook;
  }
  element.error(fmt::format("there is no entity \"{}\" that could be overlooked", wish->whom),
                "name an entity of the file, or nobody for the driver's car");
  return {};
}

ActionVariant read_hazard_command(const Element& element) {
  constexpr std::size_t longest = 100;
  HazardAction hazard{element.content()};
  if (!hazard.name.empty() && hazard.name.size() <= longest && printable_characters(hazard.name) &&
      hazard.name.find('"') == std::string::npos)
    return hazard;
  element.error(fmt::format("its content is no name of at most {} characters", longest),
                "write the hazard's name: ball and child");
  return {};
}

}  // namespace

ActionVariant read_user_defined_action(Reading& reading, const Element& action) {
  const Element command = action.child("CustomCommandAction");
  if (!command) return {};
  const std::string type = command.text("type");
  if (type == "septet:spill") return read_effect_command(reading, command, EffectAction::Kind::spill);
  if (type == "septet:black-ice") return read_black_ice(reading, command);
  if (type == "septet:ignite") return read_effect_command(reading, command, EffectAction::Kind::ignite);
  if (type == "septet:extinguish") return read_effect_command(reading, command, EffectAction::Kind::extinguish);
  if (type == "septet:call") return read_call_command(command);
  if (type == "septet:scene") return read_scene_command(command);
  if (type == "septet:errors") return read_errors_command(command);
  if (type == "septet:people") return read_people_command(command);
  if (type == "septet:overlook") return read_overlook_command(reading, command);
  if (type == "septet:hazard") return read_hazard_command(command);
  if (type == "septet:game") {
    read_game(reading, command);
    return {};
  }
  if (type != "septet:siren") {
    command.warning(
        "this command is not known and has no effect",
        "Septet knows septet:siren, septet:spill, septet:black-ice, septet:ignite, septet:extinguish, septet:call, "
        "septet:scene, septet:errors, septet:overlook, septet:people, septet:hazard, septet:game");
    return {};
  }
  if (reading.names_are_elsewhere) return {};
  const std::string content = command.content();
  const auto space = content.rfind(' ');
  const auto entity = find_entity(reading.scenario, content.substr(0, space));
  const std::string state = space == std::string::npos ? "" : content.substr(space + 1);
  if (!entity || (state != "on" && state != "off")) {
    command.error("its content is not an entity and a state of its siren", "write an entity's name and on or off");
    return {};
  }
  return SirenAction{*entity, state == "on"};
}

}  // namespace septet::scenario
