#include "engine/scenario/read/scenario_reading.hpp"

namespace septet::scenario {
namespace {

constexpr double most_m = 1e5, most_lateral_m = 1e3;
constexpr double most_s = 1e6;

std::optional<DynamicConstraints> read_constraints(const Element& parent) {
  const Element element = parent.child("DynamicConstraints");
  if (!element) return std::nullopt;
  const auto bound = [&](const char* attribute) { return element.number_or(attribute, unbounded, 0.0); };
  return DynamicConstraints{bound("maxSpeed"), bound("maxAcceleration"), bound("maxDeceleration"),
                            bound("maxAccelerationRate"), bound("maxDecelerationRate")};
}

/// Common parts of both distances; sides by the standard's words.
KeepDistanceAction read_keep_distance(Reading& reading, const Element& element,
                                      std::initializer_list<std::pair<std::string_view, std::optional<double>>> sides,
                                      std::optional<double> missing_side) {
  KeepDistanceAction action;
  action.reference = read_entity_reference(reading, element);
  action.freespace = element.required_boolean("freespace", false);
  action.continuous = element.required_boolean("continuous", false);
  action.reference_side = element.word<std::optional<double>>("displacement", sides, missing_side);
  action.system = element.word<CoordinateSystem>("coordinateSystem",
                                                 {{"entity", CoordinateSystem::entity},
                                                  {"lane", CoordinateSystem::lane},
                                                  {"road", CoordinateSystem::road},
                                                  {"world", CoordinateSystem::world},
                                                  {"trajectory", CoordinateSystem::road}},
                                                 CoordinateSystem::entity);
  if (element.text_or("coordinateSystem", "") == "trajectory") {
    element.warning("coordinateSystem=\"trajectory\" is not supported; \"road\" is taken",
                    "measure along the road or the lane");
  }
  action.limits = read_constraints(element);
  return action;
}

}  // namespace

ActionVariant read_longitudinal_distance(Reading& reading, const Element& element) {
  KeepDistanceAction action = read_keep_distance(
      reading, element, {{"trailingReferencedEntity", 1.0}, {"leadingReferencedEntity", -1.0}, {"any", std::nullopt}},
      1.0);
  action.time_gap_s = element.optional_number("timeGap", 0.0, most_s);
  action.distance_m = element.number_or("distance", 0.0, 0.0, most_m);
  if (action.time_gap_s && element.has("distance")) {
    element.warning("it has a timeGap and a distance; the timeGap is taken", "leave one of them out");
  } else if (!action.time_gap_s && !element.has("distance")) {
    element.error("it names no distance", "add distance=\"…\" or timeGap=\"…\"");
  }
  return action;
}

ActionVariant read_lateral_distance(Reading& reading, const Element& element) {
  KeepDistanceAction action = read_keep_distance(
      reading, element, {{"rightToReferencedEntity", 1.0}, {"leftToReferencedEntity", -1.0}, {"any", std::nullopt}},
      std::nullopt);
  action.lateral = true;
  action.distance_m = element.number_or("distance", 0.0, 0.0, most_lateral_m);
  return action;
}

ActionVariant read_speed_profile(Reading& reading, const Element& element) {
  SpeedProfileAction action;
  if (element.has("entityRef")) action.reference = read_entity_reference(reading, element);
  action.smooth = element.required_word<bool>("followingMode", {{"position", false}, {"follow", true}}, false);
  action.limits = read_constraints(element);
  for (const Element& entry : element.children("SpeedProfileEntry")) {
    action.entries.push_back({entry.optional_number("time", 0.0, most_s), entry.number("speed", -most_mps, most_mps)});
  }
  if (action.entries.empty()) element.error("it has no speeds", "add <SpeedProfileEntry>");
  return action;
}

ActionVariant read_synchronize(Reading& reading, const Element& element) {
  SynchronizeAction action;
  action.master = read_entity_reference(reading, element, "masterEntityRef");
  action.tolerance_m = element.number_or("targetTolerance", 0.0, 0.0, most_m);
  action.master_tolerance_m = element.number_or("targetToleranceMaster", 0.0, 0.0, most_m);
  action.target = read_position_in(reading, element.required("TargetPosition"));
  action.master_target = read_position_in(reading, element.required("TargetPositionMaster"));
  const Element final_speed = element.child("FinalSpeed");
  if (!final_speed) return action;
  using Kind = SynchronizeAction::FinalSpeed;
  action.final_speed = Kind::absolute;
  Element speed = final_speed.child("AbsoluteSpeed");
  if (!speed && (speed = final_speed.required("RelativeSpeedToMaster"))) {
    action.final_speed = speed.required_word<Kind>(
        "speedTargetValueType", {{"delta", Kind::master_plus}, {"factor", Kind::master_times}}, Kind::master_plus);
  }
  action.final_value = speed.number("value", -most_mps, most_mps);
  if (const Element distance = speed.child("TargetDistanceSteadyState"))
    action.steady_m = distance.number("distance", 0.0, most_m);
  if (const Element time = speed.child("TargetTimeSteadyState")) action.steady_s = time.number("time", 0.0, most_s);
  return action;
}

}  // namespace septet::scenario
