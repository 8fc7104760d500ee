/// People of a swarm in the drive of scenarios/town.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/simulation/server_step.hpp"
#include "engine/simulation/thrown_stage.hpp"
#include "tests/sim-server/shipped_drive.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {

TEST_CASE("who is hit by the driver's car is thrown, leaves the swarm, and is told of by his number") {
  const server::LoadedDrive loaded = server::shipped_drive("town", "desktop", 3);
  auto begun = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 3));
  REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
  State state = std::move(*begun);
  auto& people = state.people.swarm.people;
  REQUIRE(people.size() == 120);
  // He stands in the lane, two metres before the bumper of the car, which comes with 8 m/s.
  traffic::Person& person = people.front();
  const ParticipantId id = person.id;
  Snapshot now = capture_snapshot(*loaded.model, state);
  const Participant& car = now.participants.front();
  const Vec3 ahead = car.world_from_vehicle.orientation * Vec3(1.0, 0.0, 0.0);
  const Vec3 place = car.world_from_vehicle.position_m + (vehicle_models()[car.model].front_m() + 2.0) * ahead;
  person.outside = false;
  person.position_m = Vec2(place);
  person.velocity_mps = person.wanted_mps = Vec2(0.0);
  state.car.velocity_mps = Vec3(8.0, 0.0, 0.0);
  std::vector<Event> events;
  DriverInput input;
  for (int tick = 0; tick < 60; ++tick) now = server_step(*loaded.model, input, state, events);
  CHECK(is_thrown(state, id));
  CHECK(state.people.swarm.people.size() == 119);
  CHECK(std::ranges::none_of(state.people.swarm.people, [&](const traffic::Person& each) { return each.id == id; }));
  CHECK(std::ranges::count(now.participants, id, &Participant::id) == 1);
  CHECK(std::ranges::any_of(events,
                            [&](const Event& event) { return event.kind == "collision" && event.participant == id; }));
}

TEST_CASE("in five minutes of the town nobody of the people is hit by traffic") {
  const server::LoadedDrive loaded = server::shipped_drive("town", "desktop", 3);
  auto begun = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 3));
  REQUIRE_MESSAGE(begun.has_value(), why_not(begun));
  State state = std::move(*begun);
  std::vector<Event> events;
  DriverInput input;
  input.brake = 1.0;
  std::size_t crossing = 0;
  for (int tick = 0; tick < 300 * 120; ++tick) {
    const Snapshot now = server_step(*loaded.model, input, state, events);
    if (tick % 120 == 0)
      crossing += static_cast<std::size_t>(std::ranges::count_if(state.people.swarm.people, &traffic::Person::crosses));
  }
  for (const Event& event : events)
    if (event.kind == "crash_of_others") MESSAGE(event.detail);
  CHECK(state.thrown.empty());
  CHECK(crossing > 100);
}

}  // namespace septet::simulation
