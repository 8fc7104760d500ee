#pragma once
/// Small scenarios for tests: a road of three lanes each way and a storyboard to be filled in.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "tests/engine/road/road_text.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {

/// 2 km, straight along x by default, lanes 3.5 m wide, ids 1 to 3 and −1 to −3, right-hand traffic.
inline std::string road_text(const std::string& shape = "<line/>", const std::string& profiles = "") {
  return road::SmallRoad{.length_m = 2000.0,
                         .geometry = shape,
                         .profiles = profiles,
                         .sections = road::lane_section(road::left_lanes(3), road::right_lanes(3)),
                         .id = "R"}
      .xml();
}

inline road::RoadNetwork test_road(const std::string& text = road_text()) {
  auto network = road::read_opendrive(text, "test.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  return std::move(*network);
}

inline std::string vehicle_text(const std::string& name) {
  return "<ScenarioObject name=\"" + name +
         R"("><Vehicle name="saloon" vehicleCategory="car">)"
         R"(<BoundingBox><Center x="1.4" y="0" z="0.7"/><Dimensions width="1.8" length="4.6" height="1.4"/></BoundingBox>)"
         R"(<Performance maxSpeed="60" maxAcceleration="10" maxDeceleration="10"/><Axles>)"
         R"(<FrontAxle maxSteering="0.5" wheelDiameter="0.6" trackWidth="1.5" positionX="2.8" positionZ="0.3"/>)"
         R"(<RearAxle maxSteering="0" wheelDiameter="0.6" trackWidth="1.5" positionX="0" positionZ="0.3"/>)"
         R"(</Axles></Vehicle></ScenarioObject>)";
}

/// Entities A and B on the road of test_road, Init's actions, and all that stands after </Init>.
inline std::string scenario_text(const std::string& init, const std::string& stories,
                                 const std::string& declarations = "") {
  return R"(<OpenSCENARIO><FileHeader revMajor="1" revMinor="3" date="2026-01-01T00:00:00" description="" author=""/>)" +
         declarations + R"(<CatalogLocations/><RoadNetwork><LogicFile filepath="test.xodr"/></RoadNetwork><Entities>)" +
         vehicle_text("A") + vehicle_text("B") + "</Entities><Storyboard><Init><Actions>" + init + "</Actions></Init>" +
         stories + "</Storyboard></OpenSCENARIO>";
}

inline std::string private_text(const std::string& entity, const std::string& actions) {
  return "<Private entityRef=\"" + entity + "\">" + actions + "</Private>";
}
inline std::string place_text(int lane, double s) {
  return "<PrivateAction><TeleportAction><Position><LanePosition roadId=\"R\" laneId=\"" + std::to_string(lane) +
         "\" s=\"" + std::to_string(s) + "\"/></Position></TeleportAction></PrivateAction>";
}
inline std::string speed_text(double speed, const std::string& shape = "step", const std::string& dimension = "time",
                              double value = 0.0) {
  return "<PrivateAction><LongitudinalAction><SpeedAction><SpeedActionDynamics dynamicsShape=\"" + shape +
         "\" dynamicsDimension=\"" + dimension + "\" value=\"" + std::to_string(value) +
         "\"/><SpeedActionTarget><AbsoluteTargetSpeed value=\"" + std::to_string(speed) +
         "\"/></SpeedActionTarget></SpeedAction></LongitudinalAction></PrivateAction>";
}
/// A at 100 m with 20 m/s, B in the same lane 100 m ahead with 10 m/s.
inline const std::string two_cars =
    private_text("A", place_text(-2, 100) + speed_text(20)) + private_text("B", place_text(-2, 200) + speed_text(10));
inline std::string lane_change_text(int to_the_left, const std::string& shape, const std::string& dimension,
                                    double value) {
  return "<PrivateAction><LateralAction><LaneChangeAction><LaneChangeActionDynamics "
         "dynamicsShape=\"" +
         shape + "\" dynamicsDimension=\"" + dimension + "\" value=\"" + std::to_string(value) +
         "\"/><LaneChangeTarget><RelativeTargetLane entityRef=\"A\" value=\"" + std::to_string(to_the_left) +
         "\"/></LaneChangeTarget></LaneChangeAction></LateralAction></PrivateAction>";
}

inline std::string trigger_text(const std::string& condition, const std::string& edge = "none", double delay = 0.0) {
  return "<StartTrigger><ConditionGroup><Condition name=\"c\" conditionEdge=\"" + edge + "\" delay=\"" +
         std::to_string(delay) + "\">" + condition + "</Condition></ConditionGroup></StartTrigger>";
}
inline std::string time_text(double after) {
  return "<ByValueCondition><SimulationTimeCondition rule=\"greaterOrEqual\" value=\"" + std::to_string(after) +
         "\"/></ByValueCondition>";
}
inline std::string at_time(double time_s) { return trigger_text(time_text(time_s)); }
inline std::string of_entity_text(const std::string& entity, const std::string& condition) {
  return "<ByEntityCondition><TriggeringEntities triggeringEntitiesRule=\"any\"><EntityRef "
         "entityRef=\"" +
         entity + "\"/></TriggeringEntities><EntityCondition>" + condition + "</EntityCondition></ByEntityCondition>";
}
inline std::string event_text(const std::string& name, const std::string& action, const std::string& trigger,
                              const std::string& priority = "parallel", int executions = 1) {
  return "<Event name=\"" + name + "\" priority=\"" + priority + "\" maximumExecutionCount=\"" +
         std::to_string(executions) + "\"><Action name=\"" + name + " action\">" + action + "</Action>" + trigger +
         "</Event>";
}
/// One story with one act that starts at once, whose actor is A.
inline std::string story_text(const std::string& events) {
  return R"(<Story name="story"><Act name="act"><ManeuverGroup name="group" maximumExecutionCount="1">)"
         R"(<Actors selectTriggeringEntities="false"><EntityRef entityRef="A"/></Actors><Maneuver name="maneuver">)" +
         events + "</Maneuver></ManeuverGroup>" + trigger_text(time_text(0.0)) + "</Act></Story>";
}

inline Scenario read_or_stop(const std::string& text) {
  auto scenario = read_scenario(text, "test.xosc", files_in("."));
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  return std::move(*scenario);
}

/// A scenario that runs in steps of 0.01 s.
struct Drive {
  Scenario scenario;
  road::RoadNetwork network;
  ScenarioState state;
  StepResult start;
  std::vector<StoryboardEvent> events;

  explicit Drive(const std::string& text, road::RoadNetwork roads = test_road())
      : scenario(read_or_stop(text)), network(std::move(roads)) {
    auto started = start_scenario(scenario, network, no_entity, start);
    REQUIRE_MESSAGE(started.has_value(), why_not(started));
    state = std::move(*started);
  }
  void run_until(double time_s) {
    while (state.time_s < time_s - 1e-6) {
      const StepResult result = advance_scenario(scenario, network, 0.01, state);
      events.insert(events.end(), result.events.begin(), result.events.end());
    }
  }
  const EntityState& a() const { return state.entities[0]; }
  const EntityState& b() const { return state.entities[1]; }
  /// Time of the first such transition of an element whose name ends like this; −1: never.
  double time_of(const std::string& name, ElementTransition transition) const {
    for (const StoryboardEvent& event : events) {
      if (event.transition == transition && scenario.element_names[event.element].ends_with("::" + name))
        return event.time_s;
    }
    return -1.0;
  }
  int count_of(const std::string& name, ElementTransition transition) const {
    int count = 0;
    for (const StoryboardEvent& event : events) {
      if (event.transition == transition && scenario.element_names[event.element].ends_with("::" + name)) ++count;
    }
    return count;
  }
};

}  // namespace septet::scenario
