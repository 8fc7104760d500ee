#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/engine/traffic/bodies.hpp"
#include "tests/engine/traffic/emergency_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"
#include "tests/engine/traffic/swarm_run.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {

TEST_CASE("in ten seeds the ambulance is half as fast again as dense traffic without a collision") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const EmergencyRun run = drive_5_km(seed);
    MESSAGE("seed " << seed << ": ambulance " << run.ambulance_mps << " m/s, traffic " << run.traffic_mps << " m/s");
    CHECK(run.ambulance_mps >= 1.5 * run.traffic_mps);
    CHECK(run.overlaps == 0);
  }
}

TEST_CASE("by the exit and the entry vehicles move as cars do") {
  auto network = road::read_opendrive(shipped_text("scenarios/motorway-ambulance/motorway.xodr"), "motorway.xodr");
  REQUIRE(network);
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    CAPTURE(seed);
    ForeignVehicle driver;
    driver.model = model_named("volvo-s80");
    driver.world_from_vehicle = road::world_from_lane(road::evaluate_lane(*network, {0, -3, 6000.0, 0.0}));
    driver.velocity_mps = driver.world_from_vehicle.orientation * Vec3(30.0, 0.0, 0.0);
    TrafficParameters parameters = motorway_traffic(150, 1500.0);
    parameters.exit_share = 0.4;
    // The slower the ticks, the more of a step shows.
    const double tick_s = seed % 2 == 0 ? 1.0 / 120.0 : 1.0 / 30.0;
    Random random(seed, 1);
    TrafficState state = populate(parameters, *network, std::vector{driver}, random);
    REQUIRE(state.ramps.size() == 1);
    const CorridorTraffic& way = state.corridors[state.ramps.front().way];
    MotionCheck motion;
    std::vector<Participant> participants;
    std::size_t most_on_way = 0;
    for (double time_s = 0.0; time_s < 100.0; time_s += tick_s) {
      advance(parameters, *network, std::vector{driver}, tick_s, random, state);
      participants.clear();
      append_participants(state, *network, participants);
      motion.observe(participants);
      most_on_way = std::max(most_on_way, way.size());
    }
    CHECK(most_on_way > 1);
    CHECK(motion.most_sideways_m < 0.005);
    CHECK(motion.most_overturned_rad < 1e-4);
  }
}

TEST_CASE("a swarm keeps its density, and a driver follows the ambulance through it") {
  for (std::uint64_t seed = 31; seed <= 33; ++seed) {
    CAPTURE(seed);
    const SwarmRun run = follow_ambulance(dense_swarm(), 29.0, 60.0, seed);
    MESSAGE("ambulance " << run.ambulance_mps << " m/s, traffic " << run.traffic_mps << ", nearest jump "
                         << run.nearest_jump_m << " m");
    CHECK(run.ambulance_mps >= 1.5 * run.traffic_mps);
    CHECK(run.least_near > 100.0);
    CHECK(run.overlaps == 0);
    CHECK(run.overlaps_with_driver == 0);
    CHECK(run.nearest_jump_m > 600.0);  // Vehicles enter and leave out of the driver's sight.
  }
}

}  // namespace septet::traffic
