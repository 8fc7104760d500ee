// People and two-wheelers who are hit: in a drive, its snapshots, its saved states.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/person/jointed_plans.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/engine/simulation/saved_and_restored.hpp"
#include "tests/engine/simulation/thrown_drive.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

constexpr scenario::EntityIndex who = 1;
constexpr ParticipantId id = first_scripted_participant + who;

/// A level road, the driver's car, and somebody who stands on it.
Model street(const char* struck = "pedestrian") {
  using namespace scenario;
  Model model;
  model.roads = test_road();
  model.scenario =
      read_or_stop(scenario_text(private_text("A", place_text(-2, 100)) + private_text("B", place_text(-2, 200)), ""));
  model.scenario.entities[0].model = *find_vehicle_model("volvo-s80");
  model.scenario.entities[who].model = *find_vehicle_model(struck);
  model.scenario.entities[who].mass_kg = 80.0;
  model.driver_entity = 0;
  model.car = vehicle::read_car("volvo-s80");
  model.obstacles = std::make_shared<const roadside::Obstacles>(model.roads, 1);
  return model;
}

/// The car drives along the road at somebody whose back it comes to; its front is `gap_m` away.
State about_to_hit(const Model& model, double speed_mps, double aside_m = 0.0, double gap_m = 1.0) {
  auto state = initial_state(model, traffic::own_traffic(model.roads, 1));
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  const RigidTransform there = state->scenario.entities[who].world_from_entity;
  const double front_m = vehicle_models()[model.scenario.entities[0].model].front_m();
  state->car = vehicle::standstill(
      model.car, there * RigidTransform{Vec3(-front_m - gap_m, aside_m, 0.0), Quat(1.0, 0.0, 0.0, 0.0)}, speed_mps);
  state->car_road.reset();
  return std::move(*state);
}

double up_of(const Participant& participant) {
  return (participant.world_from_vehicle.orientation * Vec3(0.0, 0.0, 1.0)).z;
}

}  // namespace

TEST_CASE("a walker whom the car hits is thrown, lies, leaves his script, and the car loses what he gets") {
  const Model model = street();
  constexpr double speed_mps = 12.0;
  State state = about_to_hit(model, speed_mps), free = about_to_hit(model, speed_mps);
  free.scenario.entities[who].active = false;  // The same drive without him.
  std::vector<Event> events, others;
  Snapshot now;
  double most_lost_ns = 0.0;
  for (int tick = 0; tick < 60; ++tick) {
    now = server_step(model, {}, state, events);
    server_step(model, {}, free, others);
    most_lost_ns =
        std::max(most_lost_ns, model.car.body.mass_kg * glm::length(free.car.velocity_mps - state.car.velocity_mps));
  }
  REQUIRE(state.thrown.size() == 1);
  CHECK(free.thrown.empty());
  CHECK(std::ranges::count(events, "collision", &Event::kind) == 1);
  CHECK(std::ranges::find(events, "collision", &Event::kind)->participant == id);
  CHECK(state.scenario.entities[who].external);
  const double got_ns = glm::length(person::momentum_ns(state.thrown.front().body));
  MESSAGE("the car lost " << most_lost_ns << " N·s, he has " << got_ns);
  CHECK(got_ns > 0.6 * state.thrown.front().body.mass_kg * speed_mps);
  // The tyres of the slower car push a little otherwise, and the ground takes a part of what he got.
  CHECK(most_lost_ns == relative(got_ns, 0.3));
  // He is drawn as a body that bends, through the wire as well.
  const Participant sent = shown(from_wire(to_wire(now)), id);
  for (std::size_t i = 0; i < 4; ++i)
    CHECK(std::abs(sent.wheel_lift_m[i] - shown(now, id).wheel_lift_m[i]) < 1.0 / 4096);
  for (int tick = 0; tick < 1200; ++tick) now = server_step(model, braking(), state, events);
  CHECK(person::lies_still(state.thrown.front().body));
  CHECK(std::abs(up_of(shown(now, id))) < 0.5);
  CHECK(person::uprightness(state.thrown.front().body) < 0.4);
  CHECK(std::ranges::count_if(events, [&](const Event& e) { return e.kind == "collision" && e.participant == id; }) ==
        1);
  CHECK(glm::length(state.scenario.entities[who].world_from_entity.position_m -
                    shown(now, id).world_from_vehicle.position_m) < 1e-9);
}

TEST_CASE("a crash with a walker has the speed at which the car came to him, and what he took of it, not its braking") {
  for (const char* car : {"volvo-s80", "van"}) {
    CAPTURE(car);
    Model model = street();
    model.scenario.entities[0].model = *find_vehicle_model(car);
    State state = about_to_hit(model, 12.0);
    std::vector<Event> events;
    std::vector<Snapshot> drive;
    for (int tick = 0; tick < 360; ++tick) drive.push_back(server_step(model, braking(), state, events));
    const auto told = std::ranges::find(events, crash_event, &Event::kind);
    REQUIRE(told != events.end());
    const auto crash = read_crash(*told->participant, told->detail);
    REQUIRE(crash.has_value());
    const Vec3 before = shown(drive.at(crash->tick - 2), driver_participant).velocity_mps;
    CHECK(crash->closing_speed_mps == relative(glm::length(before), 0.02));
    REQUIRE(crash->of_first.delta_v_mps.has_value());
    Vec2 given_ns(0.0);
    for (const Vec2& push_ns : crash->pulse_ns) given_ns += push_ns;
    const Vec2 by_him = -given_ns / *crash->of_first.mass_kg;
    CHECK(glm::distance(*crash->of_first.delta_v_mps, by_him) < 0.02);  // Pieces that broke off took the rest.
    // About as by a plastic impact; its brakes take five times as much in that time.
    const double plastic_mps = 80.0 / (80.0 + *crash->of_first.mass_kg) * glm::length(before);
    CHECK(glm::length(by_him) > 0.6 * plastic_mps);
    CHECK(glm::length(by_him) < 1.8 * plastic_mps);
  }
}

TEST_CASE("who is passed at arm's length or touched slower than he walks is not thrown") {
  const Model model = street();
  std::vector<Event> events;
  State slow = about_to_hit(model, 0.6, 0.0, 0.35), past = about_to_hit(model, 12.0, 1.6);
  for (int tick = 0; tick < 60; ++tick) server_step(model, {}, slow, events);
  CHECK(slow.diagnostics.collisions == 1);
  for (int tick = 0; tick < 240; ++tick) {
    server_step(model, {}, past, events);
  }
  CHECK(slow.thrown.empty());
  CHECK(past.thrown.empty());
}

TEST_CASE("a cyclist and a motorcyclist leave their machines, and both come to rest apart") {
  for (const char* name : {"bicycle", "motorcycle"}) {
    CAPTURE(name);
    const Model model = street(name);
    State state = about_to_hit(model, 10.0);
    std::vector<Event> events;
    Snapshot now;
    for (int tick = 0; tick < 1200; ++tick) now = server_step(model, braking(), state, events);
    REQUIRE(state.thrown.size() == 2);
    CHECK(std::ranges::count(events, "collision", &Event::kind) >= 1);
    const Participant &machine = shown(now, id), &rider = shown(now, first_rider_participant + id);
    CHECK(vehicle_models()[machine.model].name == std::string(name) + "-alone");
    CHECK(vehicle_models()[rider.model].name == "pedestrian");
    for (const ThrownBody& thrown : state.thrown) CHECK(person::lies_still(thrown.body));
    CHECK(std::abs(up_of(rider)) < 0.5);
    CHECK(std::abs(up_of(machine)) < 0.5);
    CHECK(glm::length(Vec2(machine.world_from_vehicle.position_m - rider.world_from_vehicle.position_m)) > 0.5);
  }
}

TEST_CASE("a drive that is saved while somebody flies goes on with the same hashes") {
  const Model model = street();
  State state = about_to_hit(model, 12.0);
  const std::uint64_t before = hash_state(state);
  std::vector<Event> events, others;
  for (int tick = 0; tick < 50; ++tick) server_step(model, {}, state, events);
  REQUIRE(state.thrown.size() == 1);
  CHECK(hash_state(state) != before);
  State again = saved_and_restored(model, state);
  for (int tick = 0; tick < 240; ++tick) {
    const Snapshot one = server_step(model, {}, state, events), other = server_step(model, {}, again, others);
    REQUIRE(other.state_hash == one.state_hash);
    CHECK(shown(one, state.thrown.front().id).wheel_lift_m == shown(other, state.thrown.front().id).wheel_lift_m);
  }
  // Where he lies is part of the state.
  state.thrown.front().body.masses[0].position_m.x += 0.01;
  CHECK(hash_state(state) != hash_state(again));
}

}  // namespace septet::simulation
