// The scenarios that are shipped to be looked into with sight, what-if and accident: they crash, with each driver.

#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/server_step.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

/// Events of the first seconds of a shipped scenario, driven by a simulated driver.
std::vector<Event> driven(const std::string& scenario, const std::string& driver, double seconds) {
  const server::LoadedDrive loaded = server::shipped_drive(scenario, "desktop");
  auto state = initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1));
  REQUIRE(state.has_value());
  const auto seat = server::open_driver_seat(rig::Car{.driver = driver}, 1, loaded.model);
  REQUIRE(seat.has_value());
  std::vector<Event> events;
  Snapshot now = capture_snapshot(*loaded.model, *state);
  while (state->time_s() < seconds) {
    for (const auto& device : seat->devices) device->see(now);
    now = server_step(*loaded.model, seat->car->poll(state->time_s()).input, *state, events);
  }
  return events;
}

std::vector<ParticipantId> hit(const std::vector<Event>& events, std::string_view kind) {
  std::vector<ParticipantId> who;
  for (const Event& event : events)
    if (event.kind == kind && event.participant) who.push_back(*event.participant);
  return who;
}

constexpr ParticipantId crosser = first_scripted_participant + 1, walker = first_scripted_participant + 2;

}  // namespace

TEST_CASE("in crossing-crash drivers of each kind run into the car that runs its red, by their own doing") {
  for (const char* driver : {"plain", "novice", "experienced"}) {
    CAPTURE(driver);
    const auto events = driven("crossing-crash", driver, 14.0);
    CHECK(hit(events, "collision") == std::vector{crosser});
  }
}

TEST_CASE("in walker-behind-van the walker is hit") {
  for (const char* driver : {"plain", "experienced"}) {
    CAPTURE(driver);
    const auto events = driven("walker-behind-van", driver, 9.0);
    CHECK(hit(events, "collision") == std::vector{walker});
  }
}

TEST_CASE("in pile-up three cars run into the lorry and into each other, and a careful driver stops behind them") {
  const auto events = driven("pile-up", "experienced", 20.0);
  CHECK(hit(events, "crash_of_others").size() == 3);
  CHECK(hit(events, "collision").empty());
}

}  // namespace septet::simulation
