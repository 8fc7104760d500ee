#include "engine/effects/debris/crash.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/elastic/body_measures.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double crash_speed_mps = 70.0 / 3.6;

ContactWorld level_road() {
  return {[](double, double) { return GroundPoint{}; }, {}};
}

CrashBody car_at(double x_m, double speed_mps) {
  CrashBody car;
  car.box.world_from_box.position_m = {x_m, 0, 0.75};
  car.box.half_size_m = {2.2, 0.9, 0.7};
  car.box.velocity_mps = {speed_mps, 0, 0};
  car.mass_kg = 1500.0;
  car.parts = passenger_car_parts(car.box.half_size_m);
  return car;
}

/// A car whose front touches a wall at x = 0.
Crash into_barrier(double speed_mps) {
  Crash crash;
  crash.point_m = {0, 0, 0.5};
  crash.normal = {-1, 0, 0};
  crash.first = car_at(-2.2, speed_mps);
  crash.second.box.world_from_box.position_m = {0.25, 0, 0.4};
  crash.second.box.half_size_m = {0.25, 20.0, 0.4};
  return crash;
}

}  // namespace

TEST_CASE("a crash at 70 kilometres per hour throws parts and one at walking pace none") {
  for (const double speed : {crash_speed_mps, 1.0}) {
    State state;
    Random random(1);
    Crash crash = into_barrier(speed);
    const auto parts = crash.first.parts.size();
    const CrashReport report = debris::crash(state, crash, level_road(), random);
    CHECK(report.closing_speed_mps == doctest::Approx(speed));
    CHECK(crash.first.parts.size() + static_cast<std::size_t>(report.struck + report.torn_off) ==
          parts);
    CHECK(report.pieces.empty() == (speed < 2.0));
    if (speed > 2.0) CHECK(report.struck >= 3);  // Bumper and headlamps.
  }
}
