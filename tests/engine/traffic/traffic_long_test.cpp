#include <doctest/doctest.h>

#include "tests/engine/traffic/dense_run.hpp"
#include "tests/engine/traffic/swarm_run.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {

TEST_CASE("a thousand vehicle-hours of dense traffic pass without a collision") {
  double vehicle_hours = 0.0, hard_braking_s = 0.0;
  for (const bool obstacle : {false, true})
    for (const double per_km_and_lane : {10.0, 20.0, 40.0, 60.0, 80.0}) {
      CAPTURE(per_km_and_lane);
      CAPTURE(obstacle);
      const DenseRun run = drive_dense(per_km_and_lane, 350.0, 7, obstacle);
      CHECK(run.overlaps == 0);
      CHECK(run.motion.most_sideways_m < 0.01);
      CHECK(run.motion.most_overturned_rad < 1e-4);
      vehicle_hours += run.vehicle_hours;
      hard_braking_s += run.hard_braking_s;
    }
  CHECK(vehicle_hours > 1000.0);
  MESSAGE(hard_braking_s << " s below -6 m/s2 in " << vehicle_hours << " vehicle-hours");
  CHECK(hard_braking_s < 0.02 * vehicle_hours);
}

TEST_CASE("in ten seeds a driver follows the ambulance half as fast again as dense traffic") {
  for (std::uint64_t seed = 31; seed <= 40; ++seed) {
    CAPTURE(seed);
    const SwarmRun run = follow_ambulance(dense_swarm(), 29.0, 285.0, seed);
    MESSAGE("traffic " << run.traffic_mps << " m/s, at least " << run.least_near << " near, "
                       << run.overlaps_with_ambulance << " overlaps with the ambulance, nearest jump "
                       << run.nearest_jump_m << " m");
    CHECK(run.ambulance_mps >= 1.5 * run.traffic_mps);
    CHECK(run.overlaps == 0);
    CHECK(run.overlaps_with_driver == 0);
    CHECK(run.nearest_jump_m > 600.0);  // Vehicles enter and leave out of the driver's sight.
  }
}

}  // namespace septet::traffic
