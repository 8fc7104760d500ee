/// The hazards of scenarios/hazards, met by a simulated driver and set by an operator.

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/saved_state.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/hazard.hpp"
#include "logging/study/measures/hazard_reactions.hpp"
#include "tests/sim-server/taken_lesson.hpp"

namespace septet::server {

TEST_CASE(
    "an experienced driver meets the ten hazards of the way, reacts to those that he could see, and touches no "
    "person") {
  const TakenDrive taken = take_drive("hazards", "experienced", 2, 900.0);
  std::set<std::string> names;
  for (const logging::HazardReaction& reaction : logging::find_hazard_reactions(taken.events, taken.samples)) {
    CAPTURE(reaction.name);
    CAPTURE(reaction.time_s);
    names.insert(reaction.name);
    if (reaction.counts()) CHECK(reaction.response != logging::HazardResponse::censored);
  }
  CHECK(names.size() == 9);  // Two of them are somebody who runs out.
  for (const logging::Event& event : taken.events) {
    if (event.kind != "collision" || !event.participant) continue;
    CAPTURE(event.detail);
    CAPTURE(*event.participant);
    CHECK(*event.participant >= simulation::first_traffic_participant);
  }
}

namespace {

struct Standing {
  LoadedDrive loaded = shipped_drive("hazards", "desktop", 3);
  simulation::State state = begin();
  std::vector<simulation::Event> events;
  std::uint64_t hash = 0;

  simulation::State begin() const {
    auto begun = simulation::initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 3));
    REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
    return std::move(*begun);
  }
  Expected<void> command(const std::string& text) {
    const auto parsed = simulation::parse_operator_command(text);
    REQUIRE_MESSAGE(parsed.has_value(), why_not(parsed));
    return simulation::apply_operator_command(*loaded.model, *parsed, state, events);
  }
  void drive(Tick ticks) {
    DriverInput input;
    input.accelerator = 0.3;
    for (const Tick until = state.tick + ticks; state.tick < until;)
      hash = simulation::server_step(*loaded.model, input, state, events).state_hash;
  }
};

Vec3 car_of(const Standing& standing) {
  return simulation::driven_car(*standing.loaded.model, standing.state).participant.world_from_vehicle.position_m;
}

}  // namespace

TEST_CASE("an operator sets each hazard once, where a lane is, and far enough from the driver") {
  Standing standing;
  const auto offered = simulation::settable_hazards(standing.loaded.model->scenario, standing.state.scenario);
  CHECK(offered.size() == 11);
  standing.drive(1);
  const Vec3 car = car_of(standing);
  const auto at = [&](double ahead_m, const std::string& name) {
    return fmt::format("hazard x_m={} y_m={} name={}", car.x + ahead_m, car.y, name);
  };
  CHECK(!standing.command(at(10.0, "ball and child")).has_value());
  CHECK(!standing.command(at(5000.0, "ball and child")).has_value());
  CHECK(!standing.command(at(100.0, "a dragon")).has_value());
  const auto set = standing.command(at(125.0, "ball and child"));
  REQUIRE_MESSAGE(set.has_value(), why_not(set));
  CHECK(!standing.command(at(160.0, "ball and child")).has_value());
  CHECK(simulation::settable_hazards(standing.loaded.model->scenario, standing.state.scenario).size() == 10);
  standing.drive(120 * 15);
  CHECK(std::ranges::any_of(standing.events, [](const auto& event) { return event.kind == hazard_event; }));
}

TEST_CASE("a drive with a hazard that an operator has set goes on to the same hash from a saved state") {
  Standing first;
  first.drive(1);
  const Vec3 car = car_of(first);
  REQUIRE(first.command(fmt::format("hazard x_m={} y_m={} name=ball and child", car.x + 125.0, car.y)).has_value());
  first.drive(600);
  const auto saved = simulation::save_state(*first.loaded.model, first.state);
  REQUIRE(saved.has_value());
  first.drive(600);
  Standing second;
  auto restored = simulation::restore_state(*second.loaded.model, traffic::own_traffic(second.loaded.model->roads, 3),
                                            *saved, "test");
  REQUIRE_MESSAGE(restored.has_value(), why_not(restored));
  second.state = std::move(*restored);
  second.drive(600);
  CHECK(first.hash == second.hash);
}

}  // namespace septet::server
