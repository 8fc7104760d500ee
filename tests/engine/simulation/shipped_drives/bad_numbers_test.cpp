#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/simulation/server_step.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

/// Empty traffic that reports two bad numbers.
class EmptyTraffic final : public traffic::TrafficEngine {
 public:
  void start(const traffic::TrafficParameters&, std::span<const traffic::ForeignVehicle>) override {}
  void stop() override {}
  void advance(std::span<const traffic::ForeignVehicle>, double) override {}
  void append_participants(std::vector<Participant>&) const override {}
  void add_to_hash(StateHash&) const override {}
  std::uint32_t take_bad_numbers() override { return std::exchange(bad_numbers_, 0); }

 private:
  std::uint32_t bad_numbers_ = 2;
};

}  // namespace

TEST_CASE(
    "a number gone bad in controls, car, scripted vehicle or traffic is counted, reset and told, and the drive goes "
    "on") {
  const server::LoadedDrive drive = server::shipped_drive("behind-ambulance", "desktop");
  auto state = initial_state(*drive.model, std::make_unique<EmptyTraffic>());
  REQUIRE(state.has_value());
  std::vector<Event> events;
  const auto told = [&](const DriverInput& input) {
    events.clear();
    const Snapshot snapshot = server_step(*drive.model, input, *state, events);
    for (const Participant& participant : snapshot.participants)
      CHECK(std::isfinite(glm::length(participant.world_from_vehicle.position_m)));
    CHECK(std::isfinite(snapshot.driver_car.speed_mps + snapshot.driver_car.accelerator +
                        snapshot.driver_car.steering_wheel_rad));
    const bool is_told = std::ranges::any_of(events, [](const Event& event) { return event.kind == "bad_number"; });
    return is_told ? snapshot.diagnostics.bad_numbers : 0;
  };
  CHECK(told({}) == 2);  // Traffic's.
  CHECK(told({}) == 0);
  DriverInput input;
  input.accelerator = std::nan("");
  input.steering_wheel_rad = INFINITY;
  CHECK(told(input) == 4);
  const auto scripted = std::ranges::find_if(state->scenario.entities,
                                             [](const auto& entity) { return entity.active && !entity.external; });
  REQUIRE(scripted != state->scenario.entities.end());
  scripted->speed_mps = std::nan("");
  CHECK(told({}) == 5);
  state->car.velocity_mps.x = std::nan("");
  CHECK(told({}) >= 6);
  CHECK(told({}) == 0);
}

}  // namespace septet::simulation
