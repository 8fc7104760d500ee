// Crashes that a scenario stages on a shipped road: who is hit, what is told, and states saved in the middle.

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/dent.hpp"
#include "engine/math/plane_vector.hpp"
#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/engine/simulation/shipped_drives/staged_crash.hpp"
#include "tests/relative.hpp"

namespace septet::simulation {
namespace {

double told(const Event& event, const std::string& key) {
  const std::string detail = " " + event.detail;
  return std::stod(detail.substr(detail.find(" " + key + "=") + key.size() + 2));
}

Vec3 velocity_of(const Snapshot& snapshot, ParticipantId id) {
  const Participant* one = find_participant(snapshot, id);
  REQUIRE(one != nullptr);
  return one->velocity_mps;
}

const BodyContact& contact_with(const State& state, ParticipantId other) {
  const auto found = std::ranges::find_if(state.bodies.contacts, [&](const BodyContact& contact) {
    return contact.first == driver_participant && contact.second == other;
  });
  REQUIRE(found != state.bodies.contacts.end());
  REQUIRE(found->engagement.pulses.size() == 1);
  return *found;
}

}  // namespace

TEST_CASE(
    "who crosses and is run into takes the impulse, leaves its script, comes to rest, and is verified from a state "
    "that "
    "was saved in mid-crash") {
  StagedCrash crash("side");
  const ParticipantId crosser = crash.named("crosser");
  while (!crash.event("collision") && crash.state.tick < 1200) crash.step();
  REQUIRE(crash.event("collision"));
  CHECK(crash.event("collision")->participant == crosser);
  CHECK(crash.event("collision")->detail.find("by=driver") != std::string::npos);
  REQUIRE(find_loose(crash.state, crosser));
  REQUIRE(crash.pressed());
  crash.step();
  // In the middle of the impact.
  State again = crash.restored();
  CHECK(hash_state(again) == hash_state(crash.state));
  const std::size_t from = crash.inputs.size();
  std::vector<std::uint64_t> hashes;
  while (crash.state.tick < 1200) {
    crash.step();
    hashes.push_back(crash.now.state_hash);
  }
  std::vector<Event> others;
  for (std::size_t i = 0; i < hashes.size(); ++i)
    REQUIRE(server_step(*crash.loaded.model, crash.inputs[from + i], again, others).state_hash == hashes[i]);
  // The record, too, goes on where it was.
  const auto record = std::ranges::find(others, crash_event, &Event::kind);
  REQUIRE(record != others.end());
  REQUIRE(crash.event(crash_event));
  CHECK(record->detail == crash.event(crash_event)->detail);
  CHECK(glm::length(velocity_of(crash.now, crosser)) == 0.0);
  const auto ends = std::ranges::count_if(crash.events, [](const Event& event) {
    return event.kind == "scenario" && event.detail.find("crosses way") != std::string::npos &&
           event.detail.ends_with("state=complete");
  });
  CHECK(ends == 1);
}

TEST_CASE("a screen that comes in long after a crash sees the wreck where it lies, bent as it is") {
  StagedCrash crash("side");
  const ParticipantId crosser = crash.named("crosser");
  while (crash.state.tick < 2400) crash.step();
  REQUIRE(find_loose(crash.state, crosser));
  REQUIRE(glm::length(velocity_of(crash.now, crosser)) == 0.0);
  // A whole snapshot, as one is sent that holds none of the earlier ones.
  Bytes bytes;
  encode_snapshot(to_wire(crash.now), nullptr, bytes);
  const auto wire = decode_snapshot(bytes, nullptr);
  REQUIRE(wire.has_value());
  const Snapshot late = from_wire(*wire);
  const Participant *there = find_participant(crash.now, crosser), *seen = find_participant(late, crosser);
  REQUIRE(there);
  REQUIRE(seen);
  CHECK(glm::distance(there->world_from_vehicle.position_m, seen->world_from_vehicle.position_m) < 0.01);
  const auto dents_of = [](const Snapshot& snapshot) {
    const auto found = std::ranges::find(snapshot.effects, debris::dent_keyframe_kind, &EffectKeyframe::kind);
    REQUIRE(found != snapshot.effects.end());
    const auto vehicles = debris::decode_dents(found->data);
    REQUIRE(vehicles.has_value());
    return *vehicles;
  };
  const auto is_bent = [&](const debris::DentedVehicle& dented) { return dented.vehicle == crosser; };
  CHECK(std::ranges::any_of(dents_of(late), is_bent));
}

TEST_CASE("velocity and yaw rate change in a drive as the closed form says within 2 %, the tyres' share subtracted") {
  StagedCrash crash("side");
  const ParticipantId crosser = crash.named("crosser");
  const auto apart_m = [&] {
    return glm::distance(find_participant(crash.now, crosser)->world_from_vehicle.position_m,
                         find_participant(crash.now, driver_participant)->world_from_vehicle.position_m);
  };
  while (apart_m() > 8.0 && crash.state.tick < 1200) crash.step();
  // Tick by tick: what the car's own step does to its velocity, and what it is after the contact's push.
  Vec3 tyres_mps(0.0), changed_mps(0.0);
  double turned_radps = 0.0, law_radps = 0.0;
  do {
    const Vec3 before_mps = crash.state.car.velocity_mps;
    State alone = crash.restored();
    crash.step();
    alone.input = crash.inputs.back();
    std::vector<Event> none;
    advance_car(*crash.loaded.model, alone, none);
    if (!crash.event("collision")) continue;
    if (law_radps == 0.0) {
      const impact::Impulse& impulse = contact_with(crash.state, crosser).engagement.pulses.front().impulse;
      law_radps = -cross(impulse.first_arm_m, impulse.on_second_ns) / crash.loaded.model->car.body.inertia_kgm2.z;
    }
    tyres_mps += alone.car.velocity_mps - before_mps;
    changed_mps += crash.state.car.velocity_mps - before_mps;
    turned_radps += crash.state.car.angular_velocity_radps.z - alone.car.angular_velocity_radps.z;
  } while (crash.state.tick < 1200 && (!crash.event("collision") || crash.pressed()));
  REQUIRE(crash.event("collision"));
  const double given_mps = glm::length(Vec2(changed_mps - tyres_mps)),
               told_mps = told(*crash.event("collision"), "delta_v_mps");
  MESSAGE("told " << told_mps << " m/s, given " << given_mps << " m/s, by tyres " << glm::length(Vec2(tyres_mps))
                  << " m/s");
  CHECK(given_mps == relative(told_mps, 0.02));
  MESSAGE("yaw rate by the law " << law_radps << " rad/s, given " << turned_radps);
  CHECK(std::abs(law_radps) > 1.0);
  CHECK(turned_radps == relative(law_radps, 0.02));
}

TEST_CASE("two of the scenario crash with each other, and one event tells of each pair") {
  StagedCrash crash("walker");
  while (crash.state.tick < 1080) crash.step();
  REQUIRE(crash.event("crash_of_others"));
  const Event& event = *crash.event("crash_of_others");
  const ParticipantId standing = crash.named("standing"), runner = crash.named("runner");
  CHECK(event.participant == std::min(standing, runner));
  CHECK(told(event, "with") == std::max(standing, runner));
  CHECK(told(event, "by") == runner);
  CHECK(told(event, "closing_speed_mps") == relative(12.0, 0.02));
  CHECK(find_loose(crash.state, standing) != nullptr);
  CHECK(find_loose(crash.state, runner) != nullptr);
  CHECK(glm::length(velocity_of(crash.now, runner)) == 0.0);
  // The person, too, was met by the driver's car.
  REQUIRE(crash.event("collision"));
  CHECK(crash.event("collision")->participant == crash.named("walker"));
}

}  // namespace septet::simulation
