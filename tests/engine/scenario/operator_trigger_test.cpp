#include <string>

#include <doctest/doctest.h>

#include "tests/engine/scenario/scenario_text.hpp"

namespace septet::scenario {
namespace {

/// Triggers the element whose name ends like this; returns the reason of a refusal.
std::string trigger(Drive& drive, const std::string& name) {
  for (ElementIndex element = 0; element < drive.scenario.element_names.size(); ++element) {
    if (!drive.scenario.element_names[element].ends_with(name)) continue;
    StepResult result;
    const auto done = trigger_element(drive.scenario, drive.network, element, drive.state, result);
    drive.events.insert(drive.events.end(), result.events.begin(), result.events.end());
    return done ? "" : done.error().what;
  }
  return "no such element";
}

}  // namespace

TEST_CASE("an event that an operator triggers begins at once, ends as always, and begins no second time") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e", speed_text(30, "linear", "time", 2.0), at_time(1000.0)))));
  drive.run_until(1.0);
  CHECK(drive.a().speed_mps == 20.0);
  CHECK(trigger(drive, "::e") == "");
  CHECK(drive.time_of("e", ElementTransition::start) == doctest::Approx(1.0));
  CHECK(trigger(drive, "::e") == "it is running");
  drive.run_until(3.1);
  CHECK(drive.a().speed_mps == 30.0);
  CHECK(drive.count_of("e", ElementTransition::end) == 1);
  CHECK(trigger(drive, "::e") == "it is over");
}

TEST_CASE("before the first step and in an act that has not begun, an operator's event begins its act") {
  std::string story =
      story_text(event_text("e", speed_text(30), at_time(1000.0)) + event_text("f", speed_text(5), at_time(3.0)));
  const std::string begins = trigger_text(time_text(0.0));
  story.replace(story.rfind(begins), begins.size(), at_time(500.0));
  Drive drive(scenario_text(two_cars, story));
  CHECK(trigger(drive, "::e") == "");
  drive.run_until(1.0);
  CHECK(drive.a().speed_mps == 30.0);
  drive.run_until(4.0);
  CHECK(drive.a().speed_mps == 5.0);  // The act's other event has its own trigger as ever.
  Drive other(scenario_text(two_cars, story));
  other.run_until(1.0);
  CHECK(trigger(other, "::act") == "");
  CHECK(trigger(other, "::act") == "it is running");
  other.run_until(4.0);
  CHECK(other.a().speed_mps == 5.0);
}

TEST_CASE("what is neither act nor event is not triggered, and an overwriting event stops the one that runs") {
  Drive drive(scenario_text(two_cars, story_text(event_text("e", speed_text(40, "linear", "time", 20.0), at_time(0.5)) +
                                                 event_text("f", speed_text(10), at_time(1000.0), "overwrite"))));
  drive.run_until(2.0);
  CHECK(trigger(drive, "::maneuver") == "it is neither an act nor an event");
  CHECK(trigger(drive, "::e action") == "it is neither an act nor an event");
  CHECK(trigger(drive, "::f") == "");
  CHECK(drive.count_of("e", ElementTransition::stop) == 1);
  drive.run_until(3.0);
  CHECK(drive.a().speed_mps == 10.0);
  StepResult result;
  CHECK(!trigger_element(drive.scenario, drive.network, 100000, drive.state, result).has_value());
}

}  // namespace septet::scenario
