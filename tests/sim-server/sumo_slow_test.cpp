// Drives with SUMO as the traffic's engine, with the real program. Without SUMO on this machine they say so and pass.

#include <doctest/doctest.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/road/road_locate.hpp"
#include "engine/simulation/server_step.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/drive_loader.hpp"
#include "sim-server/drive/traffic_choice.hpp"
#include "sim-server/sumo/sumo_client.hpp"
#include "tests/checkout.hpp"

namespace septet::server {
namespace {

bool has_sumo() {
  if (load_sumo_module() && ::access("/usr/bin/sumo", X_OK) == 0) return true;
  MESSAGE("skipped: SUMO is not installed");
  return false;
}

std::shared_ptr<const simulation::Model> motorway() {
  ::setenv("SEPTET_DATA", source_folder().c_str(), 1);
  const auto scenario = program::find_resource("behind-ambulance", "scenarios", ".xosc");
  const auto rig = program::find_resource("desktop", "rigs", ".toml");
  REQUIRE(scenario.has_value());
  REQUIRE(rig.has_value());
  auto drive = load_drive(DriveFiles{scenario->string(), rig->string(), 1});
  REQUIRE(drive.has_value());
  return drive->model;
}

/// A drive with the accelerator held, tick by tick.
struct Ride {
  std::shared_ptr<const simulation::Model> model = motorway();
  simulation::State state;
  std::vector<simulation::Event> events;
  DriverInput input;

  explicit Ride(const std::string& engine) {
    auto traffic = open_traffic(engine, *model);
    INFO((traffic ? "" : describe(traffic.error())));
    REQUIRE(traffic.has_value());
    auto begun = simulation::initial_state(*model, std::move(*traffic));
    INFO((begun ? "" : describe(begun.error())));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    input.accelerator = 0.3;
  }
  Snapshot step() { return simulation::server_step(*model, input, state, events); }
};

std::vector<Participant> traffic_of(const Snapshot& snapshot) {
  std::vector<Participant> traffic;
  for (const auto& p : snapshot.participants)
    if (p.id >= simulation::first_traffic_participant) traffic.push_back(p);
  return traffic;
}

}  // namespace

TEST_CASE("SUMO moves the swarm that the scenario asks for and every tick follows from the one before") {
  if (!has_sumo()) return;
  Ride ride("sumo");
  std::map<ParticipantId, Participant> last;
  double worst_m = 0.0, worst_turn_rad = 0.0, worst_outside_m = 0.0;
  std::size_t least = 1000, count = 0, rough = 0, recycled = 0, braking = 0, indicating = 0;
  constexpr int ticks = 30 * 120;
  for (int tick = 0; tick < ticks; ++tick) {
    const auto traffic = traffic_of(ride.step());
    const auto error = ride.state.traffic->take_error();
    REQUIRE_MESSAGE(!error, describe(*error));
    least = std::min(least, traffic.size());
    std::map<ParticipantId, Participant> now;
    for (const Participant& p : traffic) {
      now[p.id] = p;
      ++count;
      braking += p.lamps.has(Lamp::brake);
      indicating += p.lamps.has(Lamp::indicator_left) || p.lamps.has(Lamp::indicator_right);
      if (tick % 60 == 0) {
        const Vec3& at = p.world_from_vehicle.position_m;
        const auto place = road::locate(ride.model->roads, {at.x, at.y});
        REQUIRE(place.has_value());
        worst_outside_m = std::max(worst_outside_m, place->lanes.outside_m);
      }
      const auto before = last.find(p.id);
      if (before == last.end()) continue;
      const Vec3 expected = before->second.world_from_vehicle.position_m +
                            0.5 / simulation::tick_rate_hz * (before->second.velocity_mps + p.velocity_mps);
      const double off_m = glm::length(p.world_from_vehicle.position_m - expected);
      if (off_m > 50.0) {
        ++recycled;  // Out of the swarm at its rim, in again at the other or, where the car stands, at the same one.
        continue;
      }
      rough += off_m > 0.05;
      worst_m = std::max(worst_m, off_m);
      worst_turn_rad = std::max(worst_turn_rad,
                                std::abs(road::wrap_angle(heading_rad(p.world_from_vehicle.orientation) -
                                                          heading_rad(before->second.world_from_vehicle.orientation))));
    }
    last = std::move(now);
  }
  const double mean = static_cast<double>(count) / ticks;
  MESSAGE(mean << " vehicles, at least " << least << ", recycled " << recycled << "; worst step " << worst_m
               << " m, above 5 cm " << rough << ", turn " << worst_turn_rad << " rad; braking " << braking
               << ", indicating " << indicating << " of " << count);
  CHECK(mean > 100.0);
  CHECK(worst_outside_m == 0.0);
  CHECK(worst_m < 0.5);
  CHECK(rough < count / 1000);
  CHECK(worst_turn_rad < 0.01);
  CHECK(braking > 0);
  CHECK(indicating > 0);
}

}  // namespace septet::server
