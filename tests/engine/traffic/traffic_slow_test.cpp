#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/traffic/emergency_run.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {

TEST_CASE("a thousand vehicle-hours of dense traffic pass without a collision") {
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  double vehicle_hours = 0.0;
  int overlaps = 0;
  // 15, 30 and 45 vehicles/km/lane on five lanes of 4 km.
  for (const std::uint32_t per_km_lane : {15U, 30U, 45U}) {
    const auto network = ring_road(4000.0, 5);
    TrafficState state = dense_ring(network, 5, per_km_lane * 20, per_km_lane);
    Random random(per_km_lane);
    const double hours = 0.56;
    for (int step = 0; step < static_cast<int>(hours * 36000.0); ++step) {
      advance(parameters, network, {}, 0.1, random, state);
      if (step % 5 == 0) overlaps += overlapping_bodies(state.corridors[0]);
    }
    vehicle_hours += hours * static_cast<double>(state.corridors[0].size());
  }
  CHECK(vehicle_hours > 1000.0);
  CHECK(overlaps == 0);
}

TEST_CASE("in ten seeds the ambulance is half as fast again as dense traffic without a collision") {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    CAPTURE(seed);
    const EmergencyRun run = drive_5_km(seed);
    MESSAGE("seed " << seed << ": ambulance " << run.ambulance_mps << " m/s, traffic "
                    << run.traffic_mps << " m/s");
    CHECK(run.ambulance_mps >= 1.5 * run.traffic_mps);
    CHECK(run.overlaps == 0);
  }
}

}  // namespace septet::traffic
