/// Errors of people in the drive of scenarios/town.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

constexpr std::uint64_t seed = 3;

/// The driver stands where he begins.
struct Town {
  server::LoadedDrive loaded = server::shipped_drive("town", "desktop", seed);
  State state = begin();
  std::vector<Event> events;
  std::uint64_t hash = 0;

  State begin() const {
    auto begun = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, seed));
    REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
    return std::move(*begun);
  }
  Expected<void> command(const std::string& text) {
    const auto parsed = parse_operator_command(text);
    REQUIRE_MESSAGE(parsed.has_value(), why_not(parsed));
    return apply_operator_command(*loaded.model, *parsed, state, events);
  }
  void drive(Tick ticks) {
    DriverInput input;
    input.brake = 1.0;
    for (const Tick until = state.tick + ticks; state.tick < until;)
      hash = server_step(*loaded.model, input, state, events).state_hash;
  }
  std::vector<std::string> told(std::string_view kind) const {
    std::vector<std::string> told;
    for (const Event& event : events)
      if (event.kind == kind) told.push_back(event.detail);
    return told;
  }
};

constexpr auto often = "errors overlook=1000 late_brake=1000 telephone=1000 red=1000";

}  // namespace

TEST_CASE(
    "an operator's commands for errors of people run again to the same hashes and events, also from a saved state") {
  const auto driven = [](Town& town) {
    REQUIRE(town.command(often).has_value());
    REQUIRE(town.command("overlook").has_value());
    town.drive(2400);
  };
  Town first, second;
  driven(first);
  driven(second);
  CHECK(first.hash == second.hash);
  const auto errors = first.told("error_of_people");
  CHECK(errors.size() > 5);
  CHECK(second.told("error_of_people") == errors);
  // In the middle of errors.
  REQUIRE(!first.state.traffic->erring().empty());
  const auto bytes = save_state(*first.loaded.model, first.state);
  REQUIRE(bytes.has_value());
  auto restored =
      restore_state(*second.loaded.model, traffic::own_traffic(second.loaded.model->roads, seed), *bytes, "test");
  REQUIRE_MESSAGE(restored.has_value(), why_not(restored));
  second.state = std::move(*restored);
  first.events.clear();
  second.events.clear();
  first.drive(960);
  second.drive(960);
  CHECK(first.hash == second.hash);
  CHECK(first.told("error_of_people") == second.told("error_of_people"));
}

TEST_CASE("two of a town's traffic of whom one overlooks the other crash as bodies do") {
  Town town;
  // Whoever is close behind somebody overlooks him: sooner or later the one ahead stops.
  for (int round = 0; round < 12 && town.told("crash_of_others").empty(); ++round) {
    std::vector<Participant> others;
    town.state.traffic->append_participants(others);
    for (const Participant& behind : others)
      for (const Participant& ahead : others) {
        const Vec3 apart = inverse(behind.world_from_vehicle) * ahead.world_from_vehicle.position_m;
        if (apart.x > 4.0 && apart.x < 30.0 && std::abs(apart.y) < 1.0)
          static_cast<void>(town.state.traffic->overlook(behind.id, ahead.id));
      }
    town.drive(1200);
  }
  const auto crash = std::ranges::find(town.events, std::string("crash_of_others"), &Event::kind);
  REQUIRE(crash != town.events.end());
  CHECK(crash->participant.value() >= first_traffic_participant);
  CHECK(town.state.bodies.bodies.size() >= 2);
  const auto told = town.told("error_of_people");
  CHECK(std::ranges::any_of(
      told, [](const std::string& one) { return one.find("ended=touched nearest_m=0.00") != one.npos; }));
}

}  // namespace septet::simulation
