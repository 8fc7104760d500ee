/// How a town's traffic brakes before what it can see coming.

#include <algorithm>

#include <doctest/doctest.h>

#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double line_tick_s = 1.0 / 30.0;

struct Approached {
  double least_mps2 = 0.0, way_m = 0.0, speed_mps = 0.0;
};

/// Drives for a while towards a place `to_m` ahead that is free after a time, at most at this acceleration.
Approached approach(double to_m, double free_in_s, double speed_mps, double seconds, double most_mps2) {
  Approached run{0.0, 0.0, speed_mps};
  for (double t = 0.0; t < seconds - 1e-9; t += line_tick_s) {
    const double a = std::min(most_mps2, acceleration_before(to_m - run.way_m, free_in_s - t, run.speed_mps));
    const double after = std::max(0.0, run.speed_mps + a * line_tick_s);
    run.least_mps2 = std::min(run.least_mps2, a);
    run.way_m += 0.5 * (run.speed_mps + after) * line_tick_s;
    run.speed_mps = after;
  }
  return run;
}

}  // namespace

TEST_CASE("who is too near to a line for 2 m/s2 brakes evenly and stands before it") {
  // 14 m/s, 29.8 m to where it stands: 3.29 m/s²; to catch up with 2 m/s² in half a second would take 8.2.
  const Approached run = approach(30.0, no_leader, 14.0, 20.0, 1.5);
  CHECK(run.least_mps2 > -3.5);
  CHECK(run.way_m < 30.0);
  CHECK(run.way_m > 29.0);
  CHECK(run.speed_mps < 0.1);
}

TEST_CASE("who waits for a place to be left rolls up to it and is there when it is free") {
  const Approached run = approach(40.0, 5.0, 12.0, 5.0, 1.5);
  CHECK(run.least_mps2 > -2.1);
  CHECK(run.way_m < 40.0);
  CHECK(run.way_m > 38.5);
  CHECK(run.speed_mps > 2.0);  // To stand before it and start again would take longer.
}

TEST_CASE("who is slow enough to stop at a line later is free until then") {
  CHECK(acceleration_before(100.0, no_leader, 10.0) > 1.5);
}

}  // namespace septet::traffic
