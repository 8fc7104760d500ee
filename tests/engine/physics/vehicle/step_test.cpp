// A wheel meets a step of 15 cm: a high kerb.

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

constexpr double step_m = 0.15, step_x_m = 6.0;

struct Climb {
  VehicleOutputs end;
  double highest_m = 0.0, hardest_mps2 = 0.0, gained_j = 0.0;
};

/// Rolls at a step for eight seconds; the ground is looked up at 120 Hz.
Climb climb(double speed_mps, double accelerator) {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, speed_mps);
  DriverInput input;
  input.selector = accelerator > 0.0 ? GearSelector::drive : GearSelector::neutral;
  input.accelerator = accelerator;
  const double energy_j = mechanical_energy_j(car, state);
  Ground ground = level_ground();
  Climb result;
  for (int i = 0; i < 8000; ++i) {
    if (i % 8 == 0) {
      const auto centres = wheel_centres_m(car, state);
      for (int wheel = 0; wheel < wheel_count; ++wheel) {
        const double x_m = centres[wheel].x;
        ground[wheel].point_m = {x_m, centres[wheel].y, x_m > step_x_m ? step_m : 0.0};
        ground[wheel].edges[0].reset();
        if (std::abs(x_m - step_x_m) < car.tyre.radius_m)
          ground[wheel].edges[0] = {.point_m = Vec3(step_x_m, centres[wheel].y, step_m)};
      }
    }
    advance_vehicle(car, input, ground, 0.001, state);
    result.end = outputs(car, state);
    result.highest_m = std::max(result.highest_m, result.end.world_from_vehicle.position_m.z);
    result.hardest_mps2 = std::max(result.hardest_mps2, std::abs(result.end.acceleration_mps2.z));
    result.gained_j = std::max(result.gained_j, mechanical_energy_j(car, state) - energy_j);
  }
  CHECK(state.bad_numbers == 0);
  return result;
}

}  // namespace

TEST_CASE("a car that rolls at a step of 15 cm at walking pace is stopped by it") {
  // Its front axle carries 0.58 of its weight: up 15 cm takes the car's energy at 4.7 km/h, and as much is lost in tyre
  // and damper.
  const Climb slow = climb(5.0 / 3.6, 0.0);
  CHECK(slow.end.world_from_vehicle.position_m.x < 4.0);
  CHECK(slow.highest_m < 0.05);
  CHECK(slow.gained_j < 10.0);
}

TEST_CASE("a car climbs a step of 15 cm at 30 km/h without a jump and loses speed") {
  const Climb fast = climb(30.0 / 3.6, 0.0);
  CHECK(fast.end.world_from_vehicle.position_m.x > 20.0);
  CHECK(fast.end.world_from_vehicle.position_m.z >
        0.4 * step_m);  // On its rims: so fast a strike cuts the tyres (wheel_damage_test.cpp).
  CHECK(fast.end.world_from_vehicle.position_m.z < step_m);
  CHECK(fast.highest_m < step_m + 0.15);
  CHECK(fast.end.speed_mps < 0.9 * 30.0 / 3.6);
  CHECK(fast.gained_j < 10.0);
  const Climb walking = climb(10.0 / 3.6, 0.0);
  CHECK(walking.highest_m < step_m + 0.06);
  CHECK(walking.hardest_mps2 < 40.0);
}

TEST_CASE("a car climbs a step of 15 cm from rest with the accelerator") {
  const Climb driven = climb(0.0, 0.3);
  CHECK(driven.end.world_from_vehicle.position_m.x > 10.0);
  CHECK(driven.highest_m < step_m + 0.15);
}
