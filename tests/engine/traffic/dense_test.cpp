#include <doctest/doctest.h>

#include "tests/engine/traffic/dense_run.hpp"

namespace septet::traffic {

TEST_CASE("in dense traffic no outlines overlap and everybody moves as a car does") {
  for (const double per_km_and_lane : {10.0, 20.0, 40.0, 60.0, 80.0}) {
    CAPTURE(per_km_and_lane);
    const DenseRun run = drive_dense(per_km_and_lane, 20.0, 1, false);
    CHECK(run.overlaps == 0);
    CHECK(run.least_mps2 > -5.0);
    CHECK(run.motion.most_sideways_m < 0.01);
    CHECK(run.motion.most_overturned_rad < 1e-4);
  }
}

TEST_CASE("a car that stands across two lanes is passed and touched by nobody") {
  for (const double per_km_and_lane : {10.0, 20.0, 40.0, 60.0, 80.0}) {
    CAPTURE(per_km_and_lane);
    const DenseRun run = drive_dense(per_km_and_lane, 20.0, 1, true);
    CHECK(run.overlaps == 0);
    // By those beside whom it appeared.
    CHECK(run.hard_braking_s < 2.5);
    CHECK(run.motion.most_sideways_m < 0.01);
    CHECK(run.motion.most_overturned_rad < 1e-4);
  }
}

}  // namespace septet::traffic
