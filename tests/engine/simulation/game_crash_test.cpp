// A game that ends by a crash says whose it was.

#include <numbers>

#include <doctest/doctest.h>

#include "engine/simulation/game.hpp"
#include "tests/engine/simulation/crash_site.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

constexpr ParticipantId other = first_scripted_participant + 1;

/// The game's last word, once the driver's car at `car_mps` and somebody 20 m ahead who comes at `other_mps` have met.
std::string last_word(double car_mps, double other_mps) {
  CrashSite site(plane_model(1), {{0.0, 0.0, 0.0}, {}}, car_mps,
                 {placed_participant(other, "saloon", 20.0, 0.0, std::numbers::pi, other_mps)});
  site.model.scenario.game.emplace().leader = 1;
  site.state.scenario.entities[1].active = true;
  site.state.scenario.entities[1].world_from_entity.position_m = Vec3(50.0, 0.0, 0.0);
  site.state.game = initial_game(*site.model.scenario.game, 1);
  while (site.state.diagnostics.collisions == 0 && site.state.tick < 1200) site.tick();
  // Between two ticks at which the game counts.
  site.state.tick += site.state.tick % 12 == 0 ? 1 : 0;
  advance_game(site.model, site.car.participant, site.state, site.events);
  CHECK(site.state.game->standing.end == GameEnd::crash);
  return site.events.back().kind == "game" ? site.events.back().detail : "";
}

}  // namespace

TEST_CASE("a game that ends by a crash says who ran into whom") {
  CHECK(last_word(12.0, 0.0).find("state=over why=crash by=driver") == 0);
  CHECK(last_word(0.0, 12.0).find("state=over why=crash by=other") == 0);
}
