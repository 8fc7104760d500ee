// People and two-wheelers whom others than the driver's car hit: scripted vehicles, loose bodies, several in turn.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/person/jointed_plans.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/simulation/solid_motion.hpp"
#include "engine/simulation/solids.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/world/crash_record.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/solid.hpp"
#include "tests/engine/physics/person/searle_band.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/engine/simulation/saved_and_restored.hpp"
#include "tests/engine/simulation/thrown_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

constexpr scenario::EntityIndex walker = 1, hitter = 2;
constexpr ParticipantId walker_id = first_scripted_participant + walker, car_id = first_scripted_participant + hitter;

/// A level road: the driver's car stands far ahead, somebody at 200 m, and a saloon comes along the lane to his back.
Model street(double speed_mps, const char* struck = "pedestrian", double walks_mps = 0.0, double from_m = 190.0) {
  using namespace scenario;
  std::string text = scenario_text(private_text("A", place_text(-2, 1000)) +
                                       private_text("B", place_text(-2, 200) + speed_text(walks_mps)) +
                                       private_text("C", place_text(-2, from_m) + speed_text(speed_mps)),
                                   "");
  text.insert(text.find("</Entities>"), vehicle_text("C"));
  Model model;
  model.roads = test_road();
  model.scenario = read_or_stop(text);
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.scenario.entities[walker].model = *find_vehicle_model(struck);
  model.scenario.entities[walker].mass_kg = 80.0;
  model.scenario.entities[hitter].model = *find_vehicle_model("saloon");
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  model.obstacles = std::make_shared<const roadside::Obstacles>(model.roads, 1);
  return model;
}

State begun(const Model& model) {
  auto state = initial_state(model, traffic::own_traffic(model.roads, 1));
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  return std::move(*state);
}

/// A drive until whom it throws lies still.
struct Throw {
  double hit_mps = 0.0;   ///< Speed of the vehicle in the tick before.
  double thrown_m = 0.0;  ///< Way of the mass centre in plan.
  double sinks_m = 0.0;   ///< Its height at the touch less now.
  double uprightness = 1.0;
  bool rests = false;
  std::vector<Event> events;
  Snapshot last;
};

Throw thrown_in(const Model& model, State& state) {
  Throw result;
  std::optional<Vec3> from;
  Snapshot& now = result.last;
  for (int tick = 0; tick < 2400 && !result.rests; ++tick) {
    if (!from && now.tick > 0) result.hit_mps = glm::length(shown(now, car_id).velocity_mps);
    now = server_step(model, braking(), state, result.events);
    if (state.thrown.empty()) continue;
    const person::JointedBody& body = state.thrown.front().body;
    if (!from) from = person::mass_centre_m(body);
    result.thrown_m = glm::length(Vec2(person::mass_centre_m(body) - *from));
    result.sinks_m = from->z - person::mass_centre_m(body).z;
    result.uprightness = person::uprightness(body);
    result.rests = std::ranges::all_of(state.thrown, [](const ThrownBody& b) { return person::lies_still(b.body); });
  }
  for (int tick = 0; tick < 240; ++tick) now = server_step(model, braking(), state, result.events);
  return result;
}

void check_in_searles_band(const Throw& found) {
  const searle::Band band = searle::band(found.thrown_m, found.sinks_m);
  MESSAGE(found.hit_mps << " m/s: " << found.thrown_m << " m, " << band.least_mps << " to " << band.most_mps << " m/s");
  CHECK(found.rests);
  CHECK(found.uprightness < 0.4);
  CHECK(found.hit_mps > band.least_mps);
  CHECK(found.hit_mps < band.most_mps);
}

std::ptrdiff_t count(const std::vector<Event>& events, const std::string& kind) {
  return std::ranges::count(events, kind, &Event::kind);
}

}  // namespace

TEST_CASE("who rides against a large box is thrown at its end and not within it") {
  constexpr double box_m = 8.0, middle_m = 230.0;
  Model model = street(0.0, "motorcycle", 10.0, middle_m);
  scenario::Entity& box = model.scenario.entities[hitter];
  box.kind = scenario::EntityKind::misc_object;
  box.category = "obstacle";
  box.model = box_model();
  box.box = {{0.0, 0.0, 1.3}, box_m, 2.4, 2.6};
  State state = begun(model);
  std::vector<Event> events;
  Snapshot now;
  while (state.thrown.empty() && state.tick < 600) now = server_step(model, {}, state, events);
  REQUIRE(state.thrown.size() == 2);
  const double front_m = vehicle_models()[model.scenario.entities[walker].model].front_m();
  const double reaches_m = shown(now, walker_id).world_from_vehicle.position_m.x + front_m;
  CHECK(std::abs(reaches_m - (middle_m - 0.5 * box_m)) < 0.3);
  const auto touch = std::ranges::find(events, "crash_of_others", &Event::kind);
  REQUIRE(touch != events.end());
  // The box stands fast: the rider loses all of his speed, and it nothing.
  CHECK(touch->detail.find("delta_v_mps=10.0") != std::string::npos);
  CHECK(touch->detail.find("its_delta_v_mps=0.00") != std::string::npos);
}

TEST_CASE("a scripted car that runs over a walker throws him within Searle's band, brakes, and both are named") {
  for (const double speed_mps : {6.0, 9.0, 40.0 / 3.6, 15.0, 20.0}) {
    const Model model = street(speed_mps);
    State state = begun(model);
    const Throw found = thrown_in(model, state);
    REQUIRE(state.thrown.size() == 1);
    CHECK(found.hit_mps == doctest::Approx(speed_mps));
    check_in_searles_band(found);
    CHECK(count(found.events, "collision") == 0);
    REQUIRE(count(found.events, "crash_of_others") == 1);
    const Event& touch = *std::ranges::find(found.events, "crash_of_others", &Event::kind);
    CHECK(touch.participant == walker_id);
    CHECK(told(touch, "with") == car_id);
    CHECK(told(touch, "by") == car_id);
    REQUIRE(count(found.events, "crash") == 1);
    const Event& told_crash = *std::ranges::find(found.events, "crash", &Event::kind);
    const auto record = read_crash(*told_crash.participant, told_crash.detail);
    REQUIRE(record.has_value());
    CHECK(record->second == car_id);
    // What he was given is what the car has lost: 80 kg at two thirds of its speed and more.
    REQUIRE(record->of_second.delta_v_mps.has_value());
    CHECK_FALSE(record->of_first.delta_v_mps.has_value());
    REQUIRE(impulse_ns(*record).has_value());
    CHECK(impulse_ns(*record)->x < -0.6 * 80.0 * speed_mps);
    CHECK(state.scenario.entities[walker].external);
    REQUIRE(find_loose(state, car_id) != nullptr);
    CHECK(glm::length(shown(found.last, car_id).velocity_mps) == 0.0);
  }
}

TEST_CASE("a scripted van throws a walker within Searle's band") {
  for (const double speed_mps : {5.0, 6.0, 7.0, 9.0, 40.0 / 3.6, 15.0, 20.0}) {
    Model model = street(speed_mps, "pedestrian", 0.0, 188.0);
    model.scenario.entities[hitter].model = *find_vehicle_model("van");
    State state = begun(model);
    const Throw found = thrown_in(model, state);
    REQUIRE(state.thrown.size() == 1);
    check_in_searles_band(found);
  }
}

TEST_CASE("nobody stands after a scripted vehicle has met him at more than 3 m/s") {
  for (const double speed_mps : {3.1, 4.0})
    for (const char* name : {"saloon", "van", "lorry"}) {
      CAPTURE(name);
      CAPTURE(speed_mps);
      Model model = street(speed_mps, "pedestrian", 0.0, 185.0);
      model.scenario.entities[hitter].model = *find_vehicle_model(name);
      State state = begun(model);
      const Throw found = thrown_in(model, state);
      REQUIRE(state.thrown.size() == 1);
      CHECK(found.rests);
      CHECK(found.uprightness < 0.4);
    }
}

TEST_CASE("a wreck that slides into a walker throws him as a car does") {
  const Model model = street(16.0);
  State state = begun(model);
  std::vector<Participant> scripted;
  scenario::append_participants(model.scenario, state.scenario, first_scripted_participant, scripted);
  const auto car = std::ranges::find(scripted, car_id, &Participant::id);
  REQUIRE(car != scripted.end());
  std::vector<Event> events;
  REQUIRE(leave_rails(model, *car, {}, state, events));
  const Throw found = thrown_in(model, state);
  REQUIRE(state.thrown.size() == 1);
  CHECK(found.hit_mps > 10.0);
  CHECK(found.hit_mps < 15.0);
  check_in_searles_band(found);
  CHECK(count(found.events, "crash_of_others") == 1);
  CHECK(count(found.events, "crash") == 1);
}

TEST_CASE("a cyclist whom a scripted car hits leaves the machine, and one touch is told") {
  const Model model = street(10.0, "bicycle", 4.0);
  State state = begun(model);
  const Throw found = thrown_in(model, state);
  REQUIRE(state.thrown.size() == 2);
  CHECK(found.rests);
  CHECK(count(found.events, "crash_of_others") == 1);
  CHECK(state.thrown.back().id == first_rider_participant + walker_id);
}

TEST_CASE("who lies in the road is run over by a second vehicle, which is told as well") {
  const Model model = street(9.0);
  State state = begun(model);
  thrown_in(model, state);
  const Vec3 lies_m = person::mass_centre_m(state.thrown.front().body);
  // The scripted car is out of the way; the driver's comes along.
  std::erase_if(state.bodies.bodies, [](const LooseBody& loose) { return loose.id == car_id; });
  state.scenario.entities[hitter].active = false;
  RigidTransform there = state.scenario.entities[0].world_from_entity;
  there.position_m = {lies_m.x - 8.0, lies_m.y, 0.0};
  state.car = vehicle::standstill(model.car, there, 10.0);
  state.car_road.reset();
  std::vector<Event> events;
  for (int tick = 0; tick < 180; ++tick) server_step(model, {}, state, events);
  REQUIRE(count(events, "collision") == 1);
  CHECK(std::ranges::find(events, "collision", &Event::kind)->participant == walker_id);
  CHECK(state.diagnostics.collisions == 1);
  CHECK(std::abs(person::mass_centre_m(state.thrown.front().body).x - lies_m.x) > 0.1);
}

TEST_CASE("who walks against a standing car is not thrown, and one event tells of it") {
  const Model model = street(0.0, "pedestrian", 1.4, 205.0);
  State state = begun(model);
  std::vector<Event> events;
  for (int tick = 0; tick < 600; ++tick) server_step(model, braking(), state, events);
  CHECK(state.thrown.empty());
  CHECK(count(events, "crash_of_others") == 1);
}

TEST_CASE("a vehicle that its engine keeps throws people and loses nothing") {
  const Participant lorry = placed_participant(first_traffic_participant, "lorry", 0.0, 0.0, 0.0, 10.0);
  const double front_m = vehicle_models()[lorry.model].front_m();
  CrashSite site(
      {placed_participant(first_scripted_participant + 1, "pedestrian", front_m + 0.5, 0.2, 0.0, 0.0), lorry});
  for (int tick = 0; tick < 60; ++tick) {
    site.tick();
    advance_thrown(site.model, site.car, site.participants, site.state, site.events);
  }
  CHECK(site.state.thrown.size() == 1);
  CHECK(site.state.bodies.bodies.empty());
  CHECK(site.count("crash_of_others") == 1);
  CHECK(site.participants.back().velocity_mps == Vec3(10.0, 0.0, 0.0));
}

TEST_CASE("a drive that is saved while a scripted car's victim flies goes on with the same hashes") {
  const Model model = street(12.0, "bicycle");
  State state = begun(model);
  std::vector<Event> events, others;
  int since = 0;
  while (since < 12 && state.tick < 240) {
    server_step(model, {}, state, events);
    if (!state.thrown.empty()) ++since;
  }
  REQUIRE(state.thrown.size() == 2);
  State again = saved_and_restored(model, state);
  for (int tick = 0; tick < 600; ++tick) {
    const Snapshot one = server_step(model, {}, state, events), other = server_step(model, {}, again, others);
    REQUIRE(other.state_hash == one.state_hash);
  }
  CHECK(count(others, "crash") == count(events, "crash"));
  // Whom a vehicle has met is part of the state: nobody is told twice.
  state.thrown.front().met.clear();
  CHECK(hash_state(state) != hash_state(again));
}

TEST_CASE("a solid in motion throws a walker whom it meets, which frees one with a mass and changes no other's way") {
  for (const double mass_kg : {300.0, static_cast<double>(INFINITY)}) {
    CAPTURE(mass_kg);
    const Model model = street(0.0, "pedestrian", 0.0, 100.0);
    State state = begun(model);
    std::vector<Event> events;
    const Participant person = shown(server_step(model, braking(), state, events), walker_id);
    const RigidTransform& stands = person.world_from_vehicle;
    const Vec3 from_m = stands * Vec3(-4.0, 0.0, 0.0);
    StandSolid solid{.solid = 0, .x_m = from_m.x, .y_m = from_m.y, .z_m = from_m.z, .height_m = 1.5};
    solid.mass_kg = mass_kg, solid.about_x_m = solid.x_m, solid.about_y_m = solid.y_m;
    solid.legs = {{.velocity_mps = stands.orientation * Vec3(8.0, 0.0, 0.0)}};
    REQUIRE(stand_solid(model, solid, state).has_value());
    for (int tick = 0; tick < 30; ++tick) server_step(model, braking(), state, events);
    CHECK(state.thrown.empty());
    CHECK(is_led(state, first_solid_participant));
    state = saved_and_restored(model, state);
    for (int tick = 0; tick < 60; ++tick) server_step(model, braking(), state, events);
    CHECK_FALSE(state.thrown.empty());
    CHECK(std::ranges::count(events, "crash_of_others", &Event::kind) == 1);
    CHECK(is_led(state, first_solid_participant) == std::isinf(mass_kg));
  }
}

}  // namespace septet::simulation
