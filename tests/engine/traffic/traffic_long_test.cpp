#include <doctest/doctest.h>

#include "tests/engine/traffic/dense_run.hpp"

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

}  // namespace septet::traffic
