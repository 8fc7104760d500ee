#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/hostile_driving.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("a million random inputs make neither a bad number nor energy from nothing") {
  const VehicleParameters car = read_car("volvo-s80");
  constexpr double most_power_w = 151e3;
  Random random(3);
  VehicleState state = standstill(car, {});
  double before_j = mechanical_energy_j(car, state);
  DriverInput input;
  std::uint64_t hold_steps = 0;
  for (int i = 1; i <= 1'000'000; ++i) {
    // Half of the time every step differs, half of the time the driver keeps at it for a while.
    if (hold_steps == 0) {
      input = random_input(random);
      if (random.below(1000) == 0) hold_steps = random.below(2000);
    } else {
      --hold_steps;
    }
    advance_vehicle(car, input, hilly_ground(car, state), 0.001, state);
    if (i % 1000 != 0) continue;
    const double now_j = mechanical_energy_j(car, state);
    const double flywheel_j = 0.5 * car.powertrain.engine_inertia_kgm2 * 700.0 * 700.0;
    REQUIRE(now_j < before_j + most_power_w + flywheel_j + 5000.0);
    before_j = now_j;
  }
  CHECK(state.bad_numbers == 0);
}

TEST_CASE("held random inputs on level ground never gain more energy than the engine gives") {
  const VehicleParameters car = read_car("volvo-s80");
  constexpr double most_power_w = 151e3;
  const double flywheel_j = 0.5 * car.powertrain.engine_inertia_kgm2 * 700.0 * 700.0;
  Random random(5);
  for (int drive_number = 0; drive_number < 20; ++drive_number) {
    VehicleState state = standstill(car, {}, random.uniform(-10.0, 50.0));
    const Ground ground = level_ground(0.0, random.uniform(0.05, 1.0));
    double before_j = mechanical_energy_j(car, state);
    for (int i = 0; i < 50; ++i) {
      const double held_s = random.uniform(0.05, 2.0);
      drive(car, random_input(random), ground, held_s, state);
      const double now_j = mechanical_energy_j(car, state);
      CHECK(now_j < before_j + most_power_w * held_s + flywheel_j + 500.0);
      before_j = now_j;
    }
    CHECK(state.bad_numbers == 0);
  }
}
