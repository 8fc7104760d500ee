#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {
VehicleParameters manual_car() {
  VehicleParameters car = read_car("volvo-s80");
  car.powertrain.transmission = Transmission::manual;
  return car;
}

DriverInput in_gear(int gear, double accelerator, double clutch) {
  DriverInput input;
  input.selector = GearSelector::manual;
  input.gear = static_cast<std::int8_t>(gear);
  input.accelerator = accelerator;
  input.clutch = clutch;
  return input;
}
}  // namespace

TEST_CASE("the automatic shifts up through its gears and kicks down") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {});
  DriverInput input;
  input.accelerator = 0.3;
  int highest = 0;
  for (int i = 0; i < 400; ++i) {
    drive(car, input, level_ground(), 0.1, state);
    CHECK(outputs(car, state).gear >= highest);
    highest = outputs(car, state).gear;
  }
  CHECK(highest == 4);
  VehicleState fast = standstill(car, {}, 22.0);
  CHECK(outputs(car, fast).gear >= 3);
  input.accelerator = 1.0;
  drive(car, input, level_ground(), 2.5, fast);
  CHECK(outputs(car, fast).gear <= 2);
}

TEST_CASE("a manual car drives off with the clutch and stalls without") {
  const VehicleParameters car = manual_car();
  VehicleState state = standstill(car, {});
  drive(car, in_gear(1, 0.0, 1.0), level_ground(), 0.5, state);
  CHECK(state.powertrain.gear == 1);
  for (int i = 0; i <= 100; ++i)
    drive(car, in_gear(1, 0.3, 1.0 - 0.01 * i), level_ground(), 0.025, state);
  CHECK(state.powertrain.engine_running);
  CHECK(outputs(car, state).speed_mps > 2.0);

  VehicleState stalled = standstill(car, {});
  DriverInput brake_and_release = in_gear(1, 0.0, 1.0);
  brake_and_release.brake = 1.0;
  drive(car, brake_and_release, level_ground(), 0.5, stalled);
  brake_and_release.clutch = 0.0;
  drive(car, brake_and_release, level_ground(), 1.0, stalled);
  CHECK(!stalled.powertrain.engine_running);
  brake_and_release.clutch = 1.0;
  drive(car, brake_and_release, level_ground(), 0.5, stalled);
  CHECK(stalled.powertrain.engine_running);
}

TEST_CASE("a gear needs the clutch and a gear too low is refused") {
  const VehicleParameters car = manual_car();
  VehicleState state = standstill(car, {}, 40.0);
  const int before = state.powertrain.gear;
  CHECK(before >= 3);
  drive(car, in_gear(before - 1, 0.2, 0.0), level_ground(), 0.5, state);
  CHECK(state.powertrain.gear == before);
  drive(car, in_gear(1, 0.2, 1.0), level_ground(), 1.0, state);
  CHECK(state.powertrain.gear == before);
  drive(car, in_gear(before - 1, 0.2, 1.0), level_ground(), 1.0, state);
  CHECK(state.powertrain.gear == before - 1);
}

TEST_CASE("a closed clutch turns engine and wheels together") {
  const VehicleParameters car = manual_car();
  VehicleState state = standstill(car, {}, 20.0);
  const int gear = state.powertrain.gear;
  drive(car, in_gear(gear, 0.4, 0.0), level_ground(), 3.0, state);
  const double wheel_radps = 0.5 * (state.wheels[0].spin_radps + state.wheels[1].spin_radps);
  const double input_radps =
      wheel_radps * car.powertrain.final_ratio * car.powertrain.gear_ratio[gear - 1];
  CHECK(state.powertrain.engine_radps == doctest::Approx(input_radps).epsilon(0.01));
}

TEST_CASE("reverse is refused while the car rolls forward") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 15.0);
  DriverInput input;
  input.selector = GearSelector::reverse;
  drive(car, input, level_ground(), 0.5, state);
  CHECK(outputs(car, state).gear == 0);
  input.brake = 0.5;
  drive(car, input, level_ground(), 6.0, state);
  CHECK(outputs(car, state).gear == -1);
}
