// Traffic lights: the phases of controllers as a function of time, and conditions on them.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/scenario/model/signal_plan.hpp"
#include "tests/engine/scenario/scenario_text.hpp"

namespace septet::scenario {
namespace {

std::string phase_text(const std::string& name, double duration_s, const std::string& state) {
  return "<Phase name=\"" + name + "\" duration=\"" + std::to_string(duration_s) +
         "\"><TrafficSignalState trafficSignalId=\"7\" state=\"" + state + "\"/></Phase>";
}

std::string with_signals(std::string scenario, const std::string& signals) {
  const std::string end = "</RoadNetwork>";
  return scenario.insert(scenario.find(end), "<TrafficSignals>" + signals + "</TrafficSignals>");
}

const std::string lights = "<TrafficSignalController name=\"l\">" + phase_text("go", 10, "green") +
                           phase_text("clear", 3, "amber") + phase_text("wait", 7, "red") +
                           "</TrafficSignalController>";

Expected<Scenario> read(const std::string& signals, std::vector<Finding>* warnings = nullptr,
                        const std::string& stories = "") {
  return read_scenario(with_signals(scenario_text(two_cars, stories), signals), "s.xosc", files_in("."), warnings);
}

std::string state_at(const Scenario& scenario, double time_s) {
  const SignalState* state = signal_state_at(scenario.signals, "7", time_s);
  return state ? state->state : "";
}

}  // namespace

TEST_CASE("a controller goes through its phases for ever, each from its very instant on") {
  const auto scenario = read(lights);
  REQUIRE(scenario.has_value());
  for (const double cycle_s : {0.0, 20.0, 2000.0}) {
    CHECK(state_at(*scenario, cycle_s) == "green");
    CHECK(state_at(*scenario, cycle_s + 9.99) == "green");
    CHECK(state_at(*scenario, cycle_s + 10.0) == "amber");
    CHECK(state_at(*scenario, cycle_s + 13.0) == "red");
    CHECK(state_at(*scenario, cycle_s + 19.99) == "red");
  }
  CHECK(phase_at(scenario->signals[0], 31.0).since_s == doctest::Approx(30.0));
  CHECK(state_at(*scenario, 5.0) != "");
  CHECK(signal_state_at(scenario->signals, "8", 5.0) == nullptr);
}

TEST_CASE("a delay counts from the controller that it refers to, and before it the cycle has run already") {
  std::string later = lights;
  later.replace(later.find("name=\"l\""), 8, "name=\"m\" delay=\"4\" reference=\"l\"");
  later.replace(later.find("Id=\"7\""), 6, "Id=\"8\"");
  std::string first = lights;
  first.replace(first.find("name=\"l\""), 8, "name=\"l\" delay=\"2\"");
  const auto scenario = read(first + later);
  REQUIRE(scenario.has_value());
  CHECK(scenario->signals[1].begins_s == doctest::Approx(6.0));
  CHECK(phase_at(scenario->signals[1], 5.0).phase->name == "wait");
  CHECK(phase_at(scenario->signals[1], 6.0).phase->name == "go");
}

TEST_CASE("lamps are told by words or one by one, and other words are dark and said so") {
  CHECK(lamps_of_state("red")->has(Lamp::signal_red));
  CHECK(lamps_of_state("red-amber")->has(Lamp::signal_amber));
  CHECK(lamps_of_state("on;on;off") == lamps_of_state("redYellow"));
  CHECK(lamps_of_state("off;on")->has(Lamp::signal_green));
  CHECK(lamps_of_state("off") == Lamps{});
  for (const char* none : {"", "blue", "on", "on;off;off;off", "on;;off", ";", "RED"})
    CHECK_FALSE(lamps_of_state(none).has_value());
  std::vector<Finding> warnings;
  REQUIRE(read("<TrafficSignalController name=\"l\">" + phase_text("p", 1, "blue") + "</TrafficSignalController>",
               &warnings));
  REQUIRE(warnings.size() == 1);
}

TEST_CASE("controllers without time, twice of one name, or after somebody who is not there are refused") {
  CHECK_FALSE(read("<TrafficSignalController name=\"l\"/>").has_value());
  CHECK_FALSE(read("<TrafficSignalController name=\"l\">" + phase_text("p", 0, "red") + "</TrafficSignalController>"));
  CHECK_FALSE(read("<TrafficSignalController name=\"l\">" + phase_text("p", -1, "red") + "</TrafficSignalController>"));
  CHECK_FALSE(read(lights + lights).has_value());
  std::string lost = lights;
  lost.replace(lost.find("name=\"l\""), 8, "name=\"l\" reference=\"nobody\"");
  CHECK_FALSE(read(lost).has_value());
}

TEST_CASE("an event waits for a signal's state, or for a controller's phase") {
  for (const std::string condition :
       {R"(<TrafficSignalCondition name="7" state="red"/>)",
        R"(<TrafficSignalControllerCondition trafficSignalControllerRef="l" phase="wait"/>)"}) {
    INFO(condition);
    Drive drive(with_signals(
        scenario_text(two_cars,
                      story_text(event_text("e", speed_text(20),
                                            trigger_text("<ByValueCondition>" + condition + "</ByValueCondition>")))),
        lights));
    drive.run_until(12.9);
    CHECK(drive.count_of("e", ElementTransition::start) == 0);
    drive.run_until(13.1);
    CHECK(drive.count_of("e", ElementTransition::start) == 1);
  }
}

}  // namespace septet::scenario
