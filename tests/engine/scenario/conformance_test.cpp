/// Third-party scenarios against the traces that another player made of them; see the conformance
/// set's README.

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/road/road_position.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"
#include "tests/conformance/conformance_data.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {
namespace {
namespace fs = std::filesystem;

std::string content(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

struct Loaded {
  Scenario scenario;
  road::RoadNetwork network;
  std::vector<Finding> warnings;
};

Loaded load(const std::string& name) {
  const fs::path folder = conformance_data("scenarios") / "xosc";
  Loaded loaded;
  auto scenario =
      read_scenario(content(folder / (name + ".xosc")), name + ".xosc", files_in(folder.string()), &loaded.warnings);
  REQUIRE_MESSAGE(scenario.has_value(), why_not(scenario));
  loaded.scenario = std::move(*scenario);
  auto network = road::read_opendrive(content(folder / loaded.scenario.road_file), loaded.scenario.road_file);
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  loaded.network = std::move(*network);
  return loaded;
}

struct TraceRow {
  double time_s;
  std::string name;
  Vec3 position_m;
  double heading_rad, speed_mps;
  double acceleration_mps2 = 0.0;  ///< The greater one of those before and after this row.
};

/// The rows of a table of the set, without its header, as cells.
std::vector<std::vector<std::string>> table(const std::string& file) {
  std::ifstream in(conformance_data("scenarios") / "traces" / file);
  std::vector<std::vector<std::string>> rows;
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::vector<std::string>& cells = rows.emplace_back();
    std::stringstream stream(line);
    for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  }
  return rows;
}

std::vector<TraceRow> trace(const std::string& name) {
  std::vector<TraceRow> rows;
  for (const auto& cells : table(name + ".trace.csv")) {
    rows.push_back({std::stod(cells[0]),
                    cells[1],
                    {std::stod(cells[2]), std::stod(cells[3]), std::stod(cells[4])},
                    std::stod(cells[5]),
                    std::stod(cells[8])});
  }
  std::map<std::string, TraceRow*> last;
  for (TraceRow& row : rows) {
    TraceRow*& before = last[row.name];
    if (before != nullptr && row.time_s > before->time_s) {
      const double mps2 = std::abs(row.speed_mps - before->speed_mps) / (row.time_s - before->time_s);
      before->acceleration_mps2 = std::max(before->acceleration_mps2, mps2);
      row.acceleration_mps2 = mps2;
    }
    before = &row;
  }
  return rows;
}

struct State {
  Vec3 position_m;
  double heading, speed;
};

/// Known deviations of the reference itself.
struct Exceptions {
  bool heading = true, height = true, speed = true;  ///< Compared.
  std::vector<double> left_out;                      ///< Times.
  double until_s = 1e300, from_s = 0.0;
  std::vector<std::string> only;  ///< Entities; empty: all.
  double slack_from_s = 1e300, slack_m = 0.0;
};

/// Distance of a state from a row, in units of the tolerances of the README. The trace was integrated with the speed at
/// the end of each step of 0.01 s, so that its path differs by half a step times all changes of speed so far, and in a
/// bend its heading by that of the step.
double misfit(const TraceRow& row, const State& state, const State& next, double speed_changes_mps,
              const Exceptions& but) {
  Vec3 apart = state.position_m - row.position_m;
  if (!but.height) apart.z = 0.0;
  const double slack = row.time_s >= but.slack_from_s ? but.slack_m : 0.0;
  const double position =
      glm::length(apart) / (0.05 + 0.03 * std::abs(row.speed_mps) + 0.005 * speed_changes_mps + slack);
  const double bend = std::abs(road::wrap_angle(next.heading - state.heading));
  const double turn = std::abs(road::wrap_angle(state.heading - row.heading_rad)) / (0.02 + bend);
  const double heading = but.heading ? turn : 0.0;
  const double off_mps = but.speed ? std::abs(state.speed - row.speed_mps) : 0.0;
  const double speed = off_mps / (0.05 + 0.03 * row.acceleration_mps2);
  return std::max({position, heading, speed});
}

/// Every entity's state at every step of 0.01 s, by name, until the scenario's end or a minute.
std::map<std::string, std::vector<State>> run(const Loaded& loaded, double end_s) {
  StepResult result;
  auto started = start_scenario(loaded.scenario, loaded.network, no_entity, result);
  REQUIRE_MESSAGE(started.has_value(), why_not(started));
  ScenarioState state = std::move(*started);
  std::map<std::string, std::vector<State>> states;
  for (int step = 0;; ++step) {
    for (EntityIndex i = 0; i < state.entities.size(); ++i) {
      const EntityState& entity = state.entities[i];
      states[loaded.scenario.entities[i].name].push_back(
          {entity.world_from_entity.position_m, heading_rad(entity.world_from_entity.orientation), entity.speed_mps});
    }
    if (step * 0.01 >= end_s - 1e-6) return states;
    const StepResult happened = advance_scenario(loaded.scenario, loaded.network, 0.01, state);
    if (std::getenv("SEPTET_SHOW_EVENTS") == nullptr) continue;
    for (const StoryboardEvent& event : happened.events) {
      MESSAGE(event.time_s << " " << loaded.scenario.element_names[event.element] << " "
                           << static_cast<int>(event.transition));
    }
  }
}

void check_against_trace(const std::string& name, const Exceptions& but = {}) {
  const Loaded loaded = load(name);
  std::vector<TraceRow> rows = trace(name);
  // Trailers are entities of their own in the trace; the reader names them as not supported.
  std::erase_if(rows, [&](const TraceRow& row) { return row.name.ends_with('+'); });
  std::erase_if(rows, [&](const TraceRow& row) {
    const bool other = !but.only.empty() && std::find(but.only.begin(), but.only.end(), row.name) == but.only.end();
    return other || row.time_s > but.until_s || row.time_s < but.from_s ||
           std::any_of(but.left_out.begin(), but.left_out.end(),
                       [&](double time_s) { return std::abs(row.time_s - time_s) < 0.05; });
  });
  REQUIRE_FALSE(rows.empty());
  const auto states = run(loaded, rows.back().time_s + 0.03);
  double worst = 0.0;
  std::string worst_row;
  std::map<std::string, std::pair<double, double>> speeds;  // The last one, the sum of all changes.
  for (const TraceRow& row : rows) {
    auto& [last, changes] = speeds.try_emplace(row.name, row.speed_mps, 0.0).first->second;
    changes += std::abs(row.speed_mps - last);
    last = row.speed_mps;
    const auto& of_entity = states.at(row.name);
    const auto step = static_cast<std::ptrdiff_t>(std::lround(row.time_s / 0.01));
    // A slack of 0.02 s around events: the best of the steps before and after counts.
    double least = 1e300;
    for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(0, step - 2); k <= step + 2; ++k) {
      const auto last_step = static_cast<std::ptrdiff_t>(of_entity.size()) - 1;
      const auto at = [&](std::ptrdiff_t index) -> const State& {
        return of_entity[static_cast<std::size_t>(std::min(index, last_step))];
      };
      least = std::min(least, misfit(row, at(k), at(k + 1), changes, but));
    }
    if (least > worst) {
      worst = least;
      const State& at = of_entity[static_cast<std::size_t>(step)];
      std::ostringstream text;
      text << row.name << " at " << row.time_s << " s: (" << at.position_m.x << ", " << at.position_m.y << ", "
           << at.position_m.z << ") " << at.heading << " rad, " << at.speed << " m/s; trace (" << row.position_m.x
           << ", " << row.position_m.y << ", " << row.position_m.z << ") " << row.heading_rad << " rad, "
           << row.speed_mps << " m/s";
      worst_row = text.str();
    }
  }
  INFO(name << ": worst misfit " << worst << " of the tolerance, " << worst_row);
  CHECK(worst <= 1.0);
  if (std::getenv("SEPTET_SHOW_EVENTS") != nullptr) MESSAGE(name << ": worst misfit " << worst << " " << worst_row);
}

/// Starts and ends of elements, by name and event, ascending.
using EventTimes = std::map<std::string, std::vector<double>>;

EventTimes events_of_trace(const std::string& name) {
  EventTimes times;
  for (const auto& cells : table(name + ".events.csv")) {
    // Init actions are no elements of a storyboard here, and standby is where every element begins.
    if (cells[1].starts_with("Init ") || cells[3] == "initToStandbyTransition") continue;
    times[cells[1] + (cells[3] == "startTransition" ? " starts" : " is over")].push_back(std::stod(cells[0]));
  }
  return times;
}

EventTimes events_of_run(const Loaded& loaded, double end_s) {
  StepResult at_start;
  auto state = start_scenario(loaded.scenario, loaded.network, no_entity, at_start);
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  EventTimes times;
  std::set<ElementIndex> started;
  const auto add = [&](const StepResult& result) {
    for (const StoryboardEvent& event : result.events) {
      if (event.transition == ElementTransition::none || event.transition == ElementTransition::skip) continue;
      if (event.transition == ElementTransition::start) started.insert(event.element);
      // A stop trigger also ends elements that never began; the trace omits those.
      if (!started.contains(event.element)) continue;
      // Named by its path from the story down; the trace has the last name only, and its own for the storyboard.
      const std::string& way = loaded.scenario.element_names[event.element];
      const auto colons = way.rfind("::");
      const std::string element = way.empty()                   ? "storyBoard"
                                  : colons == std::string::npos ? way
                                                                : way.substr(colons + 2);
      times[element + (event.transition == ElementTransition::start ? " starts" : " is over")].push_back(event.time_s);
    }
  };
  add(at_start);
  for (int step = 0; step * 0.01 < end_s; ++step) add(advance_scenario(loaded.scenario, loaded.network, 0.01, *state));
  for (auto& event : times) std::ranges::sort(event.second);
  return times;
}

std::string text_of(const std::vector<double>& times_s) {
  std::string text;
  for (const double time_s : times_s) text += fmt::format(" {:.2f}", time_s);
  return times_s.empty() ? " never" : text;
}

/// Every element starts and ends as often as in the reference, at its times: within 0.02 s and a step more for each
/// event before, as they may trigger one another. `otherwise`: the events that differ with a reason.
void check_events(const std::string& name, const std::set<std::string>& otherwise = {}) {
  EventTimes expected = events_of_trace(name);
  std::set<double> instants_s;
  for (const auto& event : expected) instants_s.insert(event.second.begin(), event.second.end());
  EventTimes seen = events_of_run(load(name), *instants_s.rbegin() + 0.1);
  std::set<std::string> found_otherwise;
  for (const auto& event : expected) {
    const std::vector<double>& at_s = seen[event.first];
    bool same = at_s.size() == event.second.size();
    for (std::size_t k = 0; same && k < at_s.size(); ++k) {
      const auto before = std::distance(instants_s.begin(), instants_s.lower_bound(event.second[k]));
      same = std::abs(at_s[k] - event.second[k]) < 0.0201 + 0.01 * static_cast<double>(before);
    }
    if (same) continue;
    found_otherwise.insert(event.first);
    if (!otherwise.contains(event.first))
      MESSAGE(name << ": " << event.first << " at" << text_of(at_s) << ", reference at" << text_of(event.second));
  }
  for (const auto& event : seen)
    if (!expected.contains(event.first) && !event.second.empty()) {
      found_otherwise.insert(event.first);
      if (!otherwise.contains(event.first))
        MESSAGE(name << ": " << event.first << " at" << text_of(event.second) << ", never in the reference");
    }
  CAPTURE(name);
  CHECK(found_otherwise == otherwise);
}

}  // namespace

TEST_CASE("every storyboard has the reference's events at the reference's times") {
  // The standard leaves open the course of an approach within bounds, and with it its end. Here it takes 1.0 s where
  // the reference takes 4.8 s; all that waits for it is as much earlier.
  const std::set<std::string> lateral = {"LateralDistanceAct is over",
                                         "LateralDistanceAction is over",
                                         "LateralDistanceMaxAccEvent is over",
                                         "LateralDistanceMaxAccManeuver is over",
                                         "LateralDistanceSequence is over",
                                         "LateralDistanceStory is over",
                                         "storyBoard is over"};
  // A smooth speed profile may go from speed to speed as it likes: it is over 0.17 s earlier.
  const std::set<std::string> profile = {
      "SpeedProfileAct is over",       "SpeedProfileAction1 is over",        "SpeedProfileEvent1 is over",
      "SpeedProfileManeuver1 is over", "SpeedProfileManeuverGroup1 is over", "SpeedProfileStory is over"};
  int scenarios = 0;
  for (const auto& entry : fs::directory_iterator(conformance_data("scenarios") / "xosc")) {
    if (entry.path().extension() != ".xosc") continue;
    const std::string name = entry.path().stem().string();
    check_events(name, name == "keep_lateral_distance" ? lateral
                       : name == "speed-profile"       ? profile
                                                       : std::set<std::string>{});
    ++scenarios;
  }
  CHECK(scenarios == 17);
}

TEST_CASE("a highway merge follows the reference trace") {
  // A2 and A3 keep a time gap within bounds on acceleration: how they approach it the standard leaves open.
  check_against_trace("highway_merge", {.only = {"Ego", "A1", "A4", "A5"}});
}
TEST_CASE("cut-in follows the reference trace") { check_against_trace("cut-in"); }
TEST_CASE("cut-in on curves follows the reference trace") { check_against_trace("cut-in_cr"); }
TEST_CASE("simple lane change follows the reference trace") { check_against_trace("lane_change_simple"); }
TEST_CASE("velodrome follows the reference trace") {
  // The trace turns the entities in the banked bends by the change of the bank; see the set's
  // README.
  check_against_trace("velodrome", {.heading = false});
}
TEST_CASE("slow lead vehicle follows the reference trace") { check_against_trace("slow-lead-vehicle"); }
TEST_CASE("left-hand traffic follows the reference trace") { check_against_trace("left-hand-traffic_using_road_rule"); }
TEST_CASE("two plus one road follows the reference trace") { check_against_trace("two_plus_one_road"); }

TEST_CASE("trajectories of lines clothoids and splines follow the reference trace") {
  // The standard leaves open the time along a spline between its control points: there the path is compared, not the
  // time.
  check_against_trace("trajectory-test", {.until_s = 11.95});
  const auto driven = run(load("trajectory-test"), 24.2).at("Target");
  for (const TraceRow& row : trace("trajectory-test")) {
    if (row.name != "Target" || row.time_s < 12.0 || row.time_s > 24.15) continue;
    double nearest = 1e300;
    for (const State& state : driven) nearest = std::min(nearest, glm::length(Vec2(state.position_m - row.position_m)));
    CAPTURE(row.time_s);
    CHECK(nearest < 0.15);
  }
}
TEST_CASE("clothoid splines follow the reference trace") {
  // Where the curve jumps the trace turns before it, and it is over the curve's last 0.4 m in no time.
  check_against_trace("lane-change_clothoid_spline_based_trajectory",
                      {.left_out = {13.2, 14.4, 14.5}, .slack_from_s = 14.4, .slack_m = 0.4});
}

TEST_CASE("a pedestrian on a trajectory and a car on a route follow the reference trace") {
  // The trace lifts the pedestrian by the height of a sidewalk that another road lies over.
  check_against_trace("pedestrian", {.height = false});
}
TEST_CASE("routes through junctions follow the reference trace") {
  // Two kilometres of junctions at 50 m/s: a step's length of a bend, again and again.
  check_against_trace("routing-test", {.slack_from_s = 25.0, .slack_m = 0.15});
}

TEST_CASE("a straight speed profile follows the reference trace") {
  // A smooth one may go from speed to speed as it likes.
  check_against_trace("speed-profile", {.only = {"Car2"}});
}
TEST_CASE("synchronized entities follow the reference traces") {
  check_against_trace("synch_with_steady_state");
  check_against_trace("ltap-od");
}
TEST_CASE("lateral distances follow the reference trace") {
  // In between the approach within bounds on acceleration, which the standard leaves open.
  check_against_trace("keep_lateral_distance", {.until_s = 5.5});
  check_against_trace("keep_lateral_distance", {.from_s = 26.0});
}
TEST_CASE("longitudinal distances end where the reference traces do") {
  check_against_trace("long_dist_action_with_jerk", {.only = {"Target"}});
  // Ego still gains the last 7 cm/s on it, as critical damping has it.
  check_against_trace("long_dist_action_with_jerk", {.speed = false, .from_s = 18.0, .only = {"Ego"}});
}

TEST_CASE("every scenario of the conformance set loads and names what it does not support") {
  for (const auto& entry : fs::directory_iterator(conformance_data("scenarios") / "xosc")) {
    if (entry.path().extension() != ".xosc") continue;
    const std::string name = entry.path().stem().string();
    CAPTURE(name);
    const Loaded loaded = load(name);
    for (const Finding& warning : loaded.warnings) {
      CHECK(warning.line > 0);
      if (std::getenv("SEPTET_SHOW_EVENTS") != nullptr) MESSAGE(describe(warning.error));
    }
    StepResult result;
    auto state = start_scenario(loaded.scenario, loaded.network, no_entity, result);
    REQUIRE_MESSAGE(state.has_value(), why_not(state));
    for (int step = 0; step < 1000; ++step) advance_scenario(loaded.scenario, loaded.network, 0.01, *state);
  }
}

}  // namespace septet::scenario
