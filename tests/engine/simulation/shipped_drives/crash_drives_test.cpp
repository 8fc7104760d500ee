// Crashes that a scenario stages on a shipped road: who is hit, what is told, and states saved in the middle.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/checkout.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

/// A scenario beside this file, driven by a simulated novice.
struct StagedCrash {
  server::LoadedDrive loaded;
  State state;
  server::DriverSeat seat;
  Snapshot now;
  std::vector<Event> events;
  std::vector<DriverInput> inputs;

  explicit StagedCrash(const std::string& name) {
    const std::string root = source_folder();
    auto drive = server::load_drive(server::DriveFiles{
        root + "/tests/engine/simulation/shipped_drives/" + name + ".xosc", root + "/rigs/seven-screens.toml", 1});
    REQUIRE_MESSAGE(drive.has_value(), why_not(drive));
    loaded = std::move(*drive);
    auto begun = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    auto sits = server::open_driver_seat(rig::Car{.driver = "novice"}, 1, loaded.model);
    REQUIRE(sits.has_value());
    seat = std::move(*sits);
    now = capture_snapshot(*loaded.model, state);
  }
  void step() {
    for (const auto& device : seat.devices) device->see(now);
    inputs.push_back(seat.car->poll(state.time_s()).input);
    now = server_step(*loaded.model, inputs.back(), state, events);
  }
  State restored() const {
    const auto bytes = save_state(*loaded.model, state);
    REQUIRE(bytes.has_value());
    auto again = restore_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1), *bytes, "test");
    REQUIRE_MESSAGE(again.has_value(), why_not(again));
    return std::move(*again);
  }
  const Event* event(std::string_view kind) const {
    const auto found = std::ranges::find(events, kind, &Event::kind);
    return found == events.end() ? nullptr : &*found;
  }
  ParticipantId named(std::string_view name) const {
    const auto& entities = loaded.model->scenario.entities;
    const auto found = std::ranges::find(entities, name, &scenario::Entity::name);
    REQUIRE(found != entities.end());
    return first_scripted_participant + static_cast<ParticipantId>(found - entities.begin());
  }
  bool pressed() const {
    return std::ranges::any_of(state.bodies.contacts,
                               [](const BodyContact& contact) { return !contact.engagement.pulses.empty(); });
  }
};

double told(const Event& event, const std::string& key) {
  const std::string detail = " " + event.detail;
  return std::stod(detail.substr(detail.find(" " + key + "=") + key.size() + 2));
}

Vec3 velocity_of(const Snapshot& snapshot, ParticipantId id) {
  const Participant* one = find_participant(snapshot, id);
  REQUIRE(one != nullptr);
  return one->velocity_mps;
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
  CHECK(glm::length(velocity_of(crash.now, crosser)) == 0.0);
  const auto ends = std::ranges::count_if(crash.events, [](const Event& event) {
    return event.kind == "scenario" && event.detail.find("crosses way") != std::string::npos &&
           event.detail.ends_with("state=complete");
  });
  CHECK(ends == 1);
}

TEST_CASE("the change of velocity that is told is the driven one within 2 %, the tyres' share subtracted") {
  StagedCrash crash("side");
  const ParticipantId crosser = crash.named("crosser");
  const auto apart_m = [&] {
    return glm::distance(find_participant(crash.now, crosser)->world_from_vehicle.position_m,
                         find_participant(crash.now, driver_participant)->world_from_vehicle.position_m);
  };
  while (apart_m() > 8.0 && crash.state.tick < 1200) crash.step();
  // Tick by tick: what the car's own step does to its velocity, and what it is after the contact's push.
  Vec3 tyres_mps(0.0), changed_mps(0.0);
  do {
    const Vec3 before_mps = crash.state.car.velocity_mps;
    State alone = crash.restored();
    crash.step();
    alone.input = crash.inputs.back();
    std::vector<Event> none;
    advance_car(*crash.loaded.model, alone, none);
    if (!crash.event("collision")) continue;
    tyres_mps += alone.car.velocity_mps - before_mps;
    changed_mps += crash.state.car.velocity_mps - before_mps;
  } while (crash.state.tick < 1200 && (!crash.event("collision") || crash.pressed()));
  REQUIRE(crash.event("collision"));
  const double given_mps = glm::length(Vec2(changed_mps - tyres_mps)),
               told_mps = told(*crash.event("collision"), "delta_v_mps");
  MESSAGE("told " << told_mps << " m/s, given " << given_mps << " m/s, by tyres " << glm::length(Vec2(tyres_mps))
                  << " m/s");
  CHECK(given_mps == relative(told_mps, 0.02));
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
