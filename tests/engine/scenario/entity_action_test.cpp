/// Entities that come into the world and leave it, and hazards that begin.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/scenario/scenario_text.hpp"

namespace septet::scenario {
namespace {

std::string entity_action(const std::string& entity, const std::string& what) {
  return "<GlobalAction><EntityAction entityRef=\"" + entity + "\">" + what + "</EntityAction></GlobalAction>";
}
std::string comes(const std::string& entity, int lane, double s_m) {
  return entity_action(entity, "<AddEntityAction><Position><LanePosition roadId=\"R\" laneId=\"" +
                                   std::to_string(lane) + "\" s=\"" + std::to_string(s_m) +
                                   "\"/></Position></AddEntityAction>");
}
const std::string a_alone = private_text("A", place_text(-2, 100) + speed_text(20));

std::string hazard(const std::string& content) {
  return "<UserDefinedAction><CustomCommandAction type=\"septet:hazard\">" + content +
         "</CustomCommandAction></UserDefinedAction>";
}

}  // namespace

TEST_CASE(
    "an entity without a place comes into the world where and when it is added, and leaves it when it is deleted") {
  Drive drive(
      scenario_text(a_alone, story_text(event_text("come", comes("B", -1, 300.0), at_time(1.0)) +
                                        event_text("go", entity_action("B", "<DeleteEntityAction/>"), at_time(2.0)) +
                                        event_text("again", comes("B", -3, 400.0), at_time(3.0)))));
  std::vector<Participant> others;
  drive.run_until(0.9);
  CHECK(!drive.b().active);
  append_participants(drive.scenario, drive.state, 2, others);
  CHECK(others.size() == 1);
  drive.run_until(1.5);
  CHECK(drive.b().active);
  CHECK(drive.b().lane.s_m == doctest::Approx(300.0));
  CHECK(drive.b().lane.lane == -1);
  drive.run_until(2.5);
  CHECK(!drive.b().active);
  drive.run_until(3.5);
  CHECK(drive.b().lane.s_m == doctest::Approx(400.0));
}

TEST_CASE("one who is there is not moved by being added again, and what he did goes on") {
  Drive drive(scenario_text(two_cars, story_text(event_text("come", comes("B", -1, 700.0), at_time(1.0)))));
  drive.run_until(2.0);
  CHECK(drive.b().lane.s_m == doctest::Approx(220.0));
}

TEST_CASE("the actions of one who is deleted stop with him") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("slow", speed_text(0.0, "linear", "time", 20.0), at_time(0.5)) +
                                         event_text("go", entity_action("A", "<DeleteEntityAction/>"), at_time(2.0)))));
  drive.run_until(3.0);
  CHECK(!drive.a().active);
  CHECK(drive.count_of("slow action", ElementTransition::stop) == 1);
}

TEST_CASE("a hazard tells its name and the actors of its group, with parameters of the file in its name") {
  const std::string declared =
      R"(<ParameterDeclarations><ParameterDeclaration name="what" parameterType="string" value="deer"/></ParameterDeclarations>)";
  const Scenario scenario = read_or_stop(
      scenario_text(two_cars, story_text(event_text("h", hazard("a $what runs"), at_time(0.0))), declared));
  const road::RoadNetwork network = test_road();
  StepResult start;
  auto state = start_scenario(scenario, network, no_entity, start);
  REQUIRE(state.has_value());
  const StepResult step = advance_scenario(scenario, network, 0.01, *state);
  REQUIRE(step.hazards.size() == 1);
  CHECK(step.hazards[0].name == "a deer runs");
  CHECK(step.hazards[0].actors == std::vector<EntityIndex>{0});
  CHECK(!read_scenario(scenario_text(two_cars, story_text(event_text("h", hazard("\"quoted\""), at_time(0.0)))),
                       "t.xosc", files_in("."))
             .has_value());
}

TEST_CASE("what breaks and is to be added later is named, as is an entity action that does nothing") {
  const auto findings =
      check_scenario(scenario_text(a_alone, story_text(event_text("e", entity_action("B", ""), at_time(1.0)))),
                     "t.xosc", files_in("."));
  bool told = false;
  for (const Finding& finding : findings) told = told || finding.error.what == "it does nothing";
  CHECK(told);
}

}  // namespace septet::scenario
