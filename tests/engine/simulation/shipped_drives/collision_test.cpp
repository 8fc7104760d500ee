#include <algorithm>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/server_step.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {

TEST_CASE("a vehicle that the driver's car touches is one collision for as long as they touch") {
  const server::LoadedDrive drive = server::shipped_drive("behind-ambulance", "desktop");
  auto state = initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
  REQUIRE(state.has_value());
  std::vector<Event> events;
  const auto collisions = [&] { return std::ranges::count(events, "collision", &Event::kind); };
  const Snapshot before = server_step(*drive.model, {}, *state, events);
  CHECK(collisions() == 0);
  CHECK(before.diagnostics.collisions == 0);

  const Participant* car = find_participant(before, driver_participant);
  REQUIRE(car != nullptr);
  const auto distance_m = [&](const Participant& p) {
    return p.id == car->id ? INFINITY
                           : glm::length(p.world_from_vehicle.position_m - car->world_from_vehicle.position_m);
  };
  const Participant other = *std::ranges::min_element(before.participants, {}, distance_m);
  // On a bridge above the other one nothing touches.
  const Vec3 there_m =
      state->car.world_from_body.position_m + other.world_from_vehicle.position_m - car->world_from_vehicle.position_m;
  state->car.world_from_body.position_m = there_m + Vec3(0.0, 0.0, 6.0);
  state->car.velocity_mps = other.velocity_mps;
  CHECK(server_step(*drive.model, {}, *state, events).diagnostics.collisions == 0);

  state->car.world_from_body.position_m = there_m;
  for (int tick = 0; tick < 10; ++tick) {
    const Snapshot now = server_step(*drive.model, {}, *state, events);
    CHECK(now.diagnostics.collisions == 1);
  }
  CHECK(collisions() == 1);
  const auto event = std::ranges::find(events, "collision", &Event::kind);
  REQUIRE(event != events.end());
  CHECK(event->participant == other.id);
}

}  // namespace septet::simulation
