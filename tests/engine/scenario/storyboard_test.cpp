#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/world/scene_call.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {
namespace {

std::string state_text(const std::string& type, const std::string& name, const std::string& state) {
  return "<ByValueCondition><StoryboardElementStateCondition storyboardElementType=\"" + type +
         "\" storyboardElementRef=\"" + name + "\" state=\"" + state + "\"/></ByValueCondition>";
}

}  // namespace

TEST_CASE("a rising edge fires once and none fires while the condition holds") {
  Drive rising(scenario_text(
      two_cars, story_text(event_text("e", speed_text(20), trigger_text(time_text(1.0), "rising"), "parallel", 5))));
  rising.run_until(3.0);
  CHECK(rising.count_of("e", ElementTransition::start) == 1);
  CHECK(rising.time_of("e", ElementTransition::start) == doctest::Approx(1.0));
  Drive none(scenario_text(two_cars,
                           story_text(event_text("e", speed_text(20), trigger_text(time_text(1.0)), "parallel", 5))));
  none.run_until(3.0);
  CHECK(none.count_of("e", ElementTransition::start) == 5);
}

TEST_CASE("a delay holds the condition back by its time") {
  Drive drive(scenario_text(two_cars,
                            story_text(event_text("e", speed_text(20), trigger_text(time_text(1.0), "rising", 0.5)))));
  drive.run_until(3.0);
  CHECK(drive.time_of("e", ElementTransition::start) == doctest::Approx(1.5));
}

TEST_CASE("distance conditions fire where the distance is") {
  const std::string apart =
      R"(<RelativeDistanceCondition entityRef="B" relativeDistanceType="longitudinal" coordinateSystem="road" freespace="true" rule="lessThan" value="50"/>)";
  Drive drive(scenario_text(
      two_cars,
      story_text(event_text("e", speed_text(20), trigger_text(of_entity_text("A", apart))) +
                 event_text("f", speed_text(20),
                            trigger_text(of_entity_text("A", R"(<TraveledDistanceCondition value="40"/>)"))))));
  drive.run_until(6.0);
  // 100 m apart, closing at 10 m/s; 2.3 + 1.4 − 0.9 m of the boxes lie between the reference
  // points: 4.6 m in all.
  CHECK(drive.time_of("e", ElementTransition::start) == relative(4.54, 0.005));
  CHECK(drive.time_of("f", ElementTransition::start) == relative(2.0, 0.006));
}

TEST_CASE("the freespace distance to a position is that from the box to the point") {
  const std::string near_point =
      R"(<DistanceCondition freespace="true" rule="lessThan" value="50"><Position><LanePosition roadId="R" laneId="-2" s="300"/></Position></DistanceCondition>)";
  const std::string soon =
      R"(<TimeToCollisionCondition freespace="true" rule="lessThan" value="2"><TimeToCollisionConditionTarget><Position><LanePosition roadId="R" laneId="-2" s="300"/></Position></TimeToCollisionConditionTarget></TimeToCollisionCondition>)";
  Drive drive(scenario_text(two_cars,
                            story_text(event_text("e", speed_text(20), trigger_text(of_entity_text("A", near_point))) +
                                       event_text("f", speed_text(20), trigger_text(of_entity_text("A", soon))))));
  drive.run_until(10.0);
  // At 20 m/s from 100 m, and the box reaches 3.7 m forward.
  CHECK(drive.time_of("e", ElementTransition::start) == relative((300 - 100 - 50 - 3.7) / 20, 0.002));
  CHECK(drive.time_of("f", ElementTransition::start) == relative((300 - 100 - 40 - 3.7) / 20, 0.002));
}

TEST_CASE("before 1.2 an acceleration is that of the speed") {
  // A lane change at an even speed: the whole acceleration is 0 for one step at its middle, that of the speed always.
  const std::string none = R"(<AccelerationCondition rule="equalTo" value="0"/>)";
  const auto rises = [&](const std::string& revision) {
    std::string text = scenario_text(
        two_cars, story_text(event_text("change", lane_change_text(1, "sinusoidal", "time", 4.0), at_time(1.0)) +
                             event_text("e", speed_text(20), trigger_text(of_entity_text("A", none), "falling"))));
    text.replace(text.find("revMinor=\"3\""), 12, "revMinor=\"" + revision + "\"");
    Drive drive(text);
    drive.run_until(6.0);
    return drive.count_of("e", ElementTransition::start);
  };
  CHECK(rises("2") == 1);
  CHECK(rises("1") == 0);
}

TEST_CASE("a distance along the world's axes minds the boxes") {
  const std::string apart =
      R"(<RelativeDistanceCondition entityRef="B" relativeDistanceType="longitudinal" coordinateSystem="world" freespace="true" rule="lessThan" value="50"/>)";
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e", speed_text(20), trigger_text(of_entity_text("A", apart))))));
  drive.run_until(6.0);
  CHECK(drive.time_of("e", ElementTransition::start) == relative(4.54, 0.005));
}

TEST_CASE("conditions see parameters and variables that actions change") {
  const auto value = [](const std::string& kind, const std::string& name, const std::string& change) {
    return "<GlobalAction><" + kind + "Action " + (kind == "Variable" ? "variable" : "parameter") + "Ref=\"" + name +
           "\">" + change + "</" + kind + "Action></GlobalAction>";
  };
  const std::string add = "<ModifyAction><Rule><AddValue value=\"2\"/></Rule></ModifyAction>";
  const std::string twice = "<ModifyAction><Rule><MultiplyByValue value=\"2\"/></Rule></ModifyAction>";
  const auto is = [](const std::string& kind, const std::string& reference, const std::string& rule,
                     const std::string& compared) {
    return trigger_text("<ByValueCondition><" + kind + "Condition " + reference + " rule=\"" + rule + "\" value=\"" +
                        compared + "\"/></ByValueCondition>");
  };
  const std::string declared =
      R"(<ParameterDeclarations><ParameterDeclaration name="mood" parameterType="string" value="calm"/></ParameterDeclarations>)"
      R"(<VariableDeclarations><VariableDeclaration name="count" variableType="double" value="1"/></VariableDeclarations>)";
  Drive drive(scenario_text(
      two_cars,
      story_text(event_text("add", value("Variable", "count", add), at_time(1.0)) +
                 event_text("double", value("Variable", "count", twice), at_time(2.0)) +
                 event_text("set", value("Parameter", "mood", "<SetAction value=\"angry\"/>"), at_time(3.0)) +
                 event_text("three", speed_text(20), is("Variable", "variableRef=\"count\"", "equalTo", "3")) +
                 event_text("six", speed_text(20), is("Variable", "variableRef=\"count\"", "greaterThan", "5.5")) +
                 event_text("angry", speed_text(20), is("Parameter", "parameterRef=\"mood\"", "equalTo", "angry"))),
      declared));
  drive.run_until(4.0);
  CHECK(drive.time_of("three", ElementTransition::start) == doctest::Approx(1.01));
  CHECK(drive.time_of("six", ElementTransition::start) == doctest::Approx(2.01));
  CHECK(drive.time_of("angry", ElementTransition::start) == doctest::Approx(3.01));
}

TEST_CASE("a collision is when the boxes meet") {
  const auto meets = [](const std::string& whom) {
    return trigger_text(of_entity_text("A", "<CollisionCondition>" + whom + "</CollisionCondition>"));
  };
  Drive drive(
      scenario_text(two_cars, story_text(event_text("b", speed_text(20), meets("<EntityRef entityRef=\"B\"/>")) +
                                         event_text("car", speed_text(20), meets("<ByType type=\"vehicle\"/>")) +
                                         event_text("man", speed_text(20), meets("<ByType type=\"pedestrian\"/>")))));
  drive.run_until(11.0);
  // 100 m less the 4.6 m of the boxes, at 10 m/s.
  CHECK(drive.time_of("b", ElementTransition::start) == relative(9.54, 0.002));
  CHECK(drive.time_of("car", ElementTransition::start) == drive.time_of("b", ElementTransition::start));
  CHECK(drive.count_of("man", ElementTransition::start) == 0);
}

TEST_CASE("overwrite stops the running event skip waits and parallel goes along") {
  const std::string slow = speed_text(30, "linear", "time", 4.0);
  const std::string first = event_text("first", slow, at_time(0.0));
  const auto with = [&](const std::string& priority) {
    Drive drive(scenario_text(
        two_cars,
        story_text(first + event_text("second", lane_change_text(1, "linear", "time", 1.0), at_time(1.0), priority))));
    drive.run_until(6.0);
    return drive;
  };
  const Drive overwrite = with("override");
  CHECK(overwrite.time_of("first", ElementTransition::stop) == doctest::Approx(1.0));
  CHECK(overwrite.a().speed_mps == doctest::Approx(22.5));
  const Drive skip = with("skip");
  CHECK(skip.count_of("second", ElementTransition::skip) > 100);
  CHECK(skip.time_of("second", ElementTransition::start) == doctest::Approx(4.0));
  const Drive parallel = with("parallel");
  CHECK(parallel.time_of("second", ElementTransition::start) == doctest::Approx(1.0));
  CHECK(parallel.time_of("first", ElementTransition::end) == doctest::Approx(3.99));
}

TEST_CASE("a later event hears of the end of an earlier one and the act completes") {
  Drive drive(scenario_text(
      two_cars,
      story_text(event_text("first", speed_text(30, "linear", "time", 1.0), at_time(0.5)) +
                 event_text("second", speed_text(10), trigger_text(state_text("event", "first", "endTransition"))))));
  drive.run_until(3.0);
  CHECK(drive.time_of("second", ElementTransition::start) == doctest::Approx(1.5));
  CHECK(drive.a().speed_mps == 10.0);
  CHECK(drive.time_of("act", ElementTransition::end) == doctest::Approx(1.5));
}

TEST_CASE("a new speed action takes the entity over from the old one") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("first", speed_text(40, "linear", "time", 10.0), at_time(0.0)) +
                                         event_text("second", speed_text(15, "linear", "time", 1.0), at_time(1.0)))));
  drive.run_until(3.0);
  CHECK(drive.a().speed_mps == 15.0);
  CHECK(drive.time_of("first action", ElementTransition::stop) == doctest::Approx(1.0));
}

TEST_CASE("an entity whose numbers go bad stands where it was and everything else goes on") {
  constexpr double bad = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  const std::string stories = story_text(event_text("first", speed_text(40, "linear", "time", 10.0), at_time(0.0)) +
                                         event_text("second", speed_text(15, "linear", "time", 1.0), at_time(2.0)));
  const auto with = [&](auto spoil) {
    Drive drive(scenario_text(two_cars, stories));
    drive.run_until(1.0);
    const Vec3 before = drive.a().world_from_entity.position_m;
    const double other = drive.b().travelled_m;
    spoil(drive.state.entities[0]);
    const StepResult step = advance_scenario(drive.scenario, drive.network, 0.01, drive.state);
    REQUIRE(step.reset.size() == 1);
    CHECK(step.reset[0] == 0);
    CHECK(drive.a().speed_mps == 0.0);
    CHECK(drive.a().world_from_entity.position_m == before);
    CHECK(drive.b().travelled_m > other);
    // The action that it had is over, and the next one takes it on from there.
    drive.run_until(4.0);
    CHECK(drive.a().speed_mps == 15.0);
    CHECK(drive.a().world_from_entity.position_m.x > before.x + 10.0);
  };
  with([&](EntityState& entity) { entity.speed_mps = bad; });
  with([&](EntityState& entity) {
    entity.speed_control.transition.to = endless;
    entity.speed_control.transition.from = -endless;
  });
  with([&](EntityState& entity) {
    entity.lateral_control.active = true;
    entity.lateral_control.transition = {DynamicsShape::linear, false, 1.0, 0.0, 0.0, bad};
  });
}

TEST_CASE("the stop trigger ends the scenario") {
  std::string stop = trigger_text(time_text(2.0));
  stop.replace(1, 5, "Stop");
  stop.replace(stop.rfind("StartTrigger"), 5, "Stop");
  Drive drive(scenario_text(two_cars, story_text(event_text("e", speed_text(30), at_time(5.0))) + stop));
  drive.run_until(6.0);
  CHECK(drive.state.finished);
  CHECK(drive.count_of("e", ElementTransition::start) == 0);
}

TEST_CASE("a position off the road is refused with the entity's name") {
  const Scenario scenario = read_or_stop(scenario_text(private_text("A", place_text(-7, 10)), ""));
  StepResult result;
  const auto state = start_scenario(scenario, test_road(), no_entity, result);
  REQUIRE_FALSE(state.has_value());
  CHECK(describe(state.error())
            .find("test.xosc:1, <PrivateAction>: A cannot be put on the road: road R has no lane -7 at s = 10 m") == 0);
}

TEST_CASE("an external entity is where it was put and triggers like any other") {
  const std::string near_b =
      R"(<RelativeDistanceCondition entityRef="B" relativeDistanceType="euclidianDistance" freespace="false" rule="lessThan" value="5"/>)";
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e", speed_text(30), trigger_text(of_entity_text("A", near_b))))));
  drive.state.entities[0].external = true;
  drive.run_until(1.0);
  CHECK(drive.a().world_from_entity.position_m.x == doctest::Approx(100.0));
  RigidTransform pose = drive.b().world_from_entity;
  pose.position_m.y += 4.0;
  place_external(drive.network, 0, pose, Vec3(25.0, 0.0, 0.0), Vec3(0.0), drive.state);
  CHECK(drive.a().lane.lane == -1);
  CHECK(drive.a().speed_mps == doctest::Approx(25.0));
  drive.run_until(1.02);
  CHECK(drive.time_of("e", ElementTransition::start) == doctest::Approx(1.0));
}

TEST_CASE("the ambulance of the motorway changes lanes and speed with its beacon and siren on") {
  const std::string folder = source_folder() + "/scenarios/behind-ambulance";
  const auto content = [&](const std::string& name) {
    std::ifstream in(folder + "/" + name);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const auto scenario = read_scenario(content("behind-ambulance.xosc"), "behind-ambulance.xosc", files_in(folder));
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  const auto network = road::read_opendrive(content(scenario->road_file), scenario->road_file);
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  StepResult result;
  auto state = start_scenario(*scenario, *network, no_entity, result);
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  REQUIRE(result.swarms.size() == 1);
  CHECK(result.swarms[0].vehicle_count == 200);
  CHECK(result.swarms[0].central == find_entity(*scenario, "ego"));
  CHECK(state->environment.cloud_cover == 0.25);

  const EntityIndex ambulance = *find_entity(*scenario, "ambulance");
  CHECK(state->entities[ambulance].lamps.has(Lamp::beacon));
  CHECK(state->entities[ambulance].lamps.has(Lamp::siren));
  bool changed_lane = false, slowed = false;
  double fastest = 0.0;
  double way = 0.0;
  while (state->time_s < 30.0) {
    const Vec3 before = state->entities[ambulance].world_from_entity.position_m;
    advance_scenario(*scenario, *network, 1.0 / 120.0, *state);
    const EntityState& now = state->entities[ambulance];
    way += glm::length(now.world_from_entity.position_m - before);
    changed_lane = changed_lane || now.lane.lane == -3;
    fastest = std::max(fastest, now.speed_mps);
    slowed = slowed || (state->time_s > 15.0 && now.speed_mps < 30.5);
  }
  CHECK(changed_lane);
  CHECK(slowed);
  CHECK(fastest > 32.0);
  CHECK(way == relative(state->entities[ambulance].travelled_m, 0.002));
  std::vector<Participant> participants;
  append_participants(*scenario, *state, 1, participants);
  CHECK(participants.size() == 2);
}

TEST_CASE("the road's condition brings wetness and lying snow and a scale of all friction") {
  const std::string condition =
      "<GlobalAction><EnvironmentAction><Environment name=\"winter\"><Weather temperature=\"268\"/>"
      "<RoadCondition frictionScaleFactor=\"0.8\" wetness=\"moist\"><Properties>"
      "<Property name=\"septet:snowCover\" value=\"0.6\"/><Property name=\"septet:frost\" "
      "value=\"7\"/></Properties></RoadCondition>"
      "</Environment></EnvironmentAction></GlobalAction>";
  Drive drive(scenario_text(condition + two_cars, story_text("")));
  CHECK(drive.state.friction_scale == doctest::Approx(0.8));
  CHECK(drive.state.environment.road_wetness == doctest::Approx(0.25));
  CHECK(drive.state.environment.snow_cover == doctest::Approx(0.6));
  CHECK(drive.state.environment.temperature_k == doctest::Approx(268.0));
  CHECK(std::get<EnvironmentAction>(drive.scenario.init.front().what).frost == 1.0);
}

TEST_CASE("an event of the storyboard calls, in its own name, and Init may not") {
  const auto calling = [](const std::string& text) {
    return "<UserDefinedAction><CustomCommandAction type=\"septet:call\">" + text +
           "</CustomCommandAction></UserDefinedAction>";
  };
  Drive drive(scenario_text(
      two_cars, story_text(event_text("e", calling("name=lift node=stimuli/barrier seconds=3"), at_time(0.5)))));
  std::vector<Call> calls;
  while (drive.state.time_s < 2.0) {
    const StepResult result = advance_scenario(drive.scenario, drive.network, 0.01, drive.state);
    calls.insert(calls.end(), result.calls.begin(), result.calls.end());
  }
  CHECK(calls == std::vector{Call{"lift", "stimuli/barrier", {{"seconds", "3"}}, "storyboard"}});
  for (const std::string& text : {scenario_text(two_cars + calling("name=lift"), ""),
                                  scenario_text(two_cars, story_text(event_text("e", calling("lift"), at_time(0.5))))})
    CHECK_FALSE(read_scenario(text, "test.xosc", files_in(".")).has_value());
}

TEST_CASE("Init and events set the rates at which people err, and events alone have an entity overlooked") {
  const auto command = [](const std::string& type, const std::string& text) {
    return "<UserDefinedAction><CustomCommandAction type=\"septet:" + type + "\">" + text +
           "</CustomCommandAction></UserDefinedAction>";
  };
  Drive drive(scenario_text(two_cars + command("errors", "overlook=6 red=2"),
                            story_text(event_text("e", command("overlook", "who=1007 whom=B"), at_time(0.5)))));
  CHECK(std::get<PeopleErrorRates>(drive.scenario.init.front().what).per_hour == std::array{6.0, 0.0, 0.0, 2.0});
  std::vector<OverlookAction> overlooked;
  while (drive.state.time_s < 2.0) {
    const StepResult result = advance_scenario(drive.scenario, drive.network, 0.01, drive.state);
    overlooked.insert(overlooked.end(), result.overlooked.begin(), result.overlooked.end());
  }
  REQUIRE(overlooked.size() == 1);
  CHECK(overlooked.front().who == 1007u);
  CHECK(overlooked.front().whom == find_entity(drive.scenario, "B"));
  for (const std::string& text :
       {scenario_text(two_cars + command("overlook", ""), ""),
        scenario_text(two_cars + command("errors", "sleep=1"), ""),
        scenario_text(two_cars, story_text(event_text("e", command("overlook", "whom=C"), at_time(0.5))))})
    CHECK_FALSE(read_scenario(text, "test.xosc", files_in(".")).has_value());
}

TEST_CASE("an event of the storyboard asks for a change of the scene in a call of its own, quotes and all") {
  const auto changing = [](const std::string& text) {
    return "<UserDefinedAction><CustomCommandAction type=\"septet:scene\">" + text +
           "</CustomCommandAction></UserDefinedAction>";
  };
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e", changing("hide-set \"town house/1/2\" 1"), at_time(0.5)))));
  std::vector<Call> calls;
  while (drive.state.time_s < 2.0) {
    const StepResult result = advance_scenario(drive.scenario, drive.network, 0.01, drive.state);
    calls.insert(calls.end(), result.calls.begin(), result.calls.end());
  }
  REQUIRE(calls.size() == 1);
  CHECK(scene_line_of(call_event, text_of(calls.front())) == "hide-set \"town house/1/2\" 1");
  Call others = calls.front();
  others.by = "lab";
  CHECK_FALSE(scene_line_of(call_event, text_of(others)).has_value());
  for (const std::string& text : {std::string(), std::string(longest_call_value + 1, 'a')})
    CHECK_FALSE(read_scenario(scenario_text(two_cars, story_text(event_text("e", changing(text), at_time(0.5)))),
                              "test.xosc", files_in("."))
                    .has_value());
}

}  // namespace septet::scenario
