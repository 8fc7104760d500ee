// The scenarios that are shipped to be looked into with sight, what-if and accident: they crash, with each driver.

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/engine/simulation/shipped_drives/staged_crash.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

/// Events of the first seconds of a shipped scenario, driven by a simulated driver.
std::vector<Event> driven(const std::string& scenario, const std::string& driver, double seconds) {
  StagedCrash crash(server::shipped_drive(scenario, "desktop"), driver);
  while (crash.state.time_s() < seconds) crash.step();
  return std::move(crash.events);
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

TEST_CASE("in walker-behind-van the front of the car hits the walker at 35 km/h or more, with drivers of each kind") {
  for (const char* driver : {"plain", "novice", "experienced", "tired"}) {
    CAPTURE(driver);
    const auto events = driven("walker-behind-van", driver, 9.0);
    REQUIRE(hit(events, "collision") == std::vector{walker});
    const auto collision = std::ranges::find(events, "collision", &Event::kind);
    CAPTURE(collision->detail);
    CHECK(collision->detail.find("by=driver") != std::string::npos);
    constexpr std::string_view speed = "closing_speed_mps=";
    REQUIRE(collision->detail.starts_with(speed));
    CHECK(std::stod(collision->detail.substr(speed.size())) > 35.0 / 3.6);
  }
}

TEST_CASE("in pile-up three cars run into the lorry and into each other, and a careful driver stops behind them") {
  const auto events = driven("pile-up", "experienced", 20.0);
  CHECK(hit(events, "crash_of_others").size() == 3);
  CHECK(hit(events, "collision").empty());
}

}  // namespace septet::simulation
