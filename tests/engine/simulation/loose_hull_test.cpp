// Loose bodies against rails, walls, trees and posts: what holds them, what it costs, and what is told.

#include "engine/simulation/bodies/loose_hull.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "engine/physics/vehicle/hull_outline.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/crash_record.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/engine/simulation/saved_and_restored.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr ParticipantId thrown_one = first_scripted_participant + 1;
constexpr double rail_y_m = -8.0, rail_radius_m = 0.08;

std::string object(const char* type, double s, double t, const char* more) {
  return fmt::format(R"(<object id="1" type="{}" s="{}" t="{}" {}/>)", type, s, t, more);
}

Model made_roadside() {
  Model model = plane_model(1);
  const std::string objects = object("barrier", 200.0, rail_y_m, R"(subtype="guardRail" length="400" height="0.75")") +
                              object("tree", 100.0, 12.0, R"(height="11" radius="2")") +
                              object("pole", 200.0, 12.0, R"(height="4" radius="0.1")");
  model.roads = road::read_or_fail(
      road::SmallRoad{.length_m = 400.0, .id = "R", .after_lanes = "<objects>" + objects + "</objects>"}.xml());
  model.obstacles = std::make_shared<const roadside::Obstacles>(model.roads, 1);
  return model;
}

/// A road along x with a guard rail on its right, a tree and a post.
const Model& roadside_model() {
  static const Model model = made_roadside();
  return model;
}

struct Thrown {
  double x_m = 0.0, y_m = 0.0;
  double heading_rad = 0.0;  ///< Of the vehicle,
  double way_rad = 0.0;      ///< and of its motion.
  double speed_mps = 0.0, yaw_rate_radps = 0.0;
};

CrashSite thrown(const Thrown& with) {
  Participant saloon = placed_participant(thrown_one, "saloon", with.x_m, with.y_m, with.heading_rad, 0.0);
  CrashSite site(roadside_model(), {{0.0, 1e4, 0.0}, {}}, 0.0, {saloon});
  LooseBody loose = loose_body(saloon, 1450.0);
  loose.body.velocity_mps = with.speed_mps * Vec2(std::cos(with.way_rad), std::sin(with.way_rad));
  loose.body.yaw_rate_radps = with.yaw_rate_radps;
  site.state.bodies.bodies.push_back(loose);
  return site;
}

const LooseBody& body_of(const CrashSite& site) { return site.state.bodies.bodies.front(); }

/// By how much the outline less what is crushed off it reaches into what stands.
double beyond_crush_m(const CrashSite& site) {
  const LooseBody& loose = body_of(site);
  const impact::Side whole = side_of(loose);
  const auto near = site.model.obstacles->near(loose.body.mass_centre_m, 10.0);
  double most_m = 0.0;
  for (const vehicle::Entered& each :
       vehicle::entered_obstacles({whole.outline, -10.0, 10.0}, loose.body.mass_centre_m, near, loose.hull.touches)) {
    if (each.obstacle->yielding_kg > 0.0) continue;  // It is knocked over.
    const auto touch = std::ranges::find(loose.hull.touches, each.obstacle->run, &vehicle::HullTouch::run);
    const impact::Cuts cuts = touch == loose.hull.touches.end() ? impact::Cuts{} : touch->engagement.first;
    const auto met = impact::contact_of(impact::crushed(whole.outline, cuts), each.outline);
    if (met) most_m = std::max(most_m, -met->gap_m);
  }
  return most_m;
}

double energy_missing(const LooseBody& loose) {
  double missing = 0.0;
  for (const vehicle::HullTouch& touch : loose.hull.touches) {
    const impact::Ledger& ledger = touch.engagement.ledger;
    if (ledger.kinetic_j > 100.0)
      missing = std::max(missing, std::abs(ledger.kinetic_j - ledger.crush_j - ledger.friction_j) / ledger.kinetic_j);
  }
  return missing;
}

}  // namespace

TEST_CASE("a car thrown at a rail does not pass it, and reaches into it no farther than it is crushed") {
  double deepest_m = 0.0, missing = 0.0;
  for (const double speed : {5.0, 15.0, 30.0, 60.0})
    for (const double degrees : {5.0, 30.0, 60.0, 90.0})
      for (const double turned : {0.0, 1.0, 1.57, 3.0}) {
        CAPTURE(speed);
        CAPTURE(degrees);
        CAPTURE(turned);
        const double way = -degrees * 3.14159265 / 180.0;
        CrashSite site = thrown({150.0, rail_y_m + 3.2, way + turned, way, speed, 0.5});
        for (int i = 0; i < 720 && !(site.rests() && i > 0); ++i) {
          site.tick();
          deepest_m = std::max(deepest_m, beyond_crush_m(site));
          missing = std::max(missing, energy_missing(body_of(site)));
          if (body_of(site).body.mass_centre_m.x > 395.0) break;
        }
        // Broadside at 60 m/s it is crushed beyond its middle, and still all on its side.
        CHECK(body_of(site).body.mass_centre_m.y > rail_y_m - (speed < 20.0 ? 0.0 : 0.9));
      }
  MESSAGE("deepest beyond the crush " << 1000.0 * deepest_m << " mm, energy missing " << missing);
  CHECK(deepest_m < 0.01);
  CHECK(missing < 0.001);
}

TEST_CASE("a tree and a post stop a car that is thrown at them") {
  for (const double x_m : {100.0, 200.0})
    for (const double speed : {8.0, 20.0, 40.0}) {
      CAPTURE(x_m);
      CAPTURE(speed);
      CrashSite site = thrown({x_m, 5.0, 1.5707963, 1.5707963, speed});
      for (int i = 0; i < 240; ++i) site.tick();
      CHECK(site.rests());
      CHECK(body_of(site).body.mass_centre_m.y < 12.0);
      CHECK(beyond_crush_m(site) < 0.01);
    }
}

TEST_CASE("what a rail gives a body is what the body's momentum has lost") {
  CrashSite site = thrown({150.0, rail_y_m + 2.0, -0.6, -0.5, 25.0});
  LooseBody& loose = site.state.bodies.bodies.front();
  const auto obstacles = site.model.obstacles->near(loose.body.mass_centre_m, 30.0);
  const Vec2 before_ns = loose.body.mass_kg * loose.body.velocity_mps;
  vehicle::HullReport report;
  double most_ns = 0.0;
  for (int i = 0; i < 400; ++i) {
    loose.body.mass_centre_m += tick_s / 8.0 * loose.body.velocity_mps;
    loose.body.heading_rad += tick_s / 8.0 * loose.body.yaw_rate_radps;
    meet_obstacles(obstacles, tick_s / 8.0, {}, loose, report);
    Vec2 given_ns(0.0);
    for (const vehicle::HullTouch& touch : loose.hull.touches) given_ns += touch.engagement.given_ns;
    most_ns = std::max(most_ns, glm::distance(before_ns, loose.body.mass_kg * loose.body.velocity_mps + given_ns));
  }
  REQUIRE(report.begun.size() == 1);
  CHECK(report.begun.front().mass_kg == 1450.0);
  CHECK(most_ns < 1e-9 * glm::length(before_ns));
}

TEST_CASE("the log tells what a wreck ran into and what that came to, and the driver's count stays") {
  CrashSite site = thrown({150.0, rail_y_m + 4.0, -0.7, -0.7, 18.0});
  for (int i = 0; i < 600; ++i) site.tick();
  REQUIRE(site.count("crash_of_others") == 1);
  const auto touch = std::ranges::find(site.events, std::string("crash_of_others"), &Event::kind);
  CHECK(touch->participant == thrown_one);
  CHECK(touch->detail.starts_with("guard rail closing_speed_mps="));
  CHECK(site.state.diagnostics.collisions == 0);
  REQUIRE(site.count(crash_event) == 1);
  const auto told = std::ranges::find(site.events, std::string(crash_event), &Event::kind);
  const auto record = read_crash(*told->participant, told->detail);
  REQUIRE(record.has_value());
  CHECK(record->first == thrown_one);
  CHECK(record->stands == "guard rail");
  REQUIRE(record->ledger.has_value());
  const CrashLedger& ledger = *record->ledger;
  CHECK(ledger.kinetic_before_j == relative(0.5 * 1450.0 * 18.0 * 18.0, 0.2));
  CHECK(std::abs(ledger.kinetic_before_j - ledger.kinetic_after_j - ledger.crush_j - ledger.friction_j -
                 ledger.debris_j - ledger.wheels_j) < 0.001 * ledger.kinetic_before_j);
  // The effects break and dent the wreck, not the driver's car.
  REQUIRE(!site.state.effects.crashes.struck_standing.empty());
  CHECK(site.state.effects.crashes.struck_standing.front().vehicle == thrown_one);
}

TEST_CASE("a state that was saved while a rail presses a wreck goes on with the same hashes") {
  Model model = roadside_model();
  model.scenario =
      scenario::read_or_stop(scenario::scenario_text(scenario::private_text("A", scenario::place_text(-1, 40)) +
                                                         scenario::private_text("B", scenario::place_text(-1, 150)),
                                                     ""));
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  auto begun = initial_state(model, traffic::own_traffic(model.roads, 1));
  REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
  State state = std::move(*begun);
  std::vector<Event> events;
  server_step(model, {}, state, events);
  // Somebody has thrown the other one at the rail.
  const Snapshot there = capture_snapshot(model, state);
  const Participant* other = find_participant(there, first_scripted_participant + 1);
  REQUIRE(other != nullptr);
  REQUIRE(leave_rails(model, *other, there.participants.front(), state, events));
  LooseBody& loose = state.bodies.bodies.front();
  loose.body.velocity_mps = {14.0, -12.0};
  const auto is_pressed = [&] {
    return std::ranges::any_of(state.bodies.bodies.front().hull.touches,
                               [](const vehicle::HullTouch& touch) { return !touch.engagement.pulses.empty(); });
  };
  for (int i = 0; i < 240 && !is_pressed(); ++i) server_step(model, {}, state, events);
  REQUIRE(is_pressed());
  State again = saved_and_restored(model, state);
  std::vector<Event> told_again;
  events.clear();
  for (int i = 0; i < 360; ++i)
    REQUIRE(server_step(model, {}, again, told_again).state_hash == server_step(model, {}, state, events).state_hash);
  REQUIRE(events.size() == told_again.size());
  for (std::size_t i = 0; i < events.size(); ++i) CHECK(events[i].detail == told_again[i].detail);
  CHECK(std::ranges::count(events, std::string("crash_of_others"), &Event::kind) == 1);
}

TEST_CASE("a car that pushes a wreck onto a rail does not push it through") {
  Participant saloon = placed_participant(thrown_one, "saloon", 150.0, rail_y_m + 1.0, 0.0, 0.0);
  // The driver's car comes on across the road.
  CrashSite site(roadside_model(), {{150.5, rail_y_m + 8.0, 0.0}, orientation_from_angles(-1.5707963, 0.0, 0.0)}, 20.0,
                 {saloon});
  for (int i = 0; i < 480; ++i) {
    site.tick();
    if (!site.state.bodies.bodies.empty()) CHECK(beyond_crush_m(site) < 0.01);
  }
  REQUIRE(site.state.bodies.bodies.size() == 1);
  CHECK(body_of(site).body.mass_centre_m.y > rail_y_m);
  CHECK(site.rests());
}
