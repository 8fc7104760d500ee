#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

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
  for (int i = 0; i <= 100; ++i) drive(car, in_gear(1, 0.3, 1.0 - 0.01 * i), level_ground(), 0.025, state);
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
  const double input_radps = wheel_radps * car.powertrain.final_ratio * car.powertrain.gear_ratio[gear - 1];
  CHECK(state.powertrain.engine_radps == relative(input_radps, 0.01));
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

TEST_CASE("a car that rolled back on a steep hill is pulled up it again in its gear") {
  for (const bool automatic : {true, false}) {
    CAPTURE(automatic);
    const VehicleParameters car = automatic ? read_car("volvo-s80") : manual_car();
    const double slope_rad = -std::atan(0.20);
    const Ground hill = sloping_ground(slope_rad);
    const RigidTransform uphill{Vec3(0.0), orientation_from_angles(0.0, slope_rad, 0.0)};
    VehicleState state = standstill(car, uphill);
    drive(car, in_gear(1, 0.0, 1.0), hill, 0.5, state);  // Clutch down: the gear goes in, the car rolls.
    DriverInput rolling = in_gear(1, 0.0, 1.0);
    if (automatic) rolling.selector = GearSelector::drive;
    while (outputs(car, state).speed_mps > -4.0 && state.bad_numbers == 0) {
      rolling.parking_brake = false;
      drive(car, rolling, hill, 0.1, state);
    }
    CHECK(outputs(car, state).gear == 1);
    DriverInput full = in_gear(1, 1.0, 1.0);
    if (automatic) full.selector = GearSelector::drive;
    drive(car, full, hill, 0.5, state);
    full.clutch = 0.45;
    drive(car, full, hill, 6.0, state);
    CHECK(outputs(car, state).speed_mps > 3.0);
  }
}

TEST_CASE("a stalled engine holds the car on a hill in gear until it is turned over") {
  const VehicleParameters car = manual_car();
  for (const double direction : {1.0, -1.0})
    for (const double grade : {0.05, 0.10, 0.30}) {
      CAPTURE(grade);
      CAPTURE(direction);
      const double slope_rad = -direction * std::atan(grade);
      const Ground hill = sloping_ground(slope_rad);
      VehicleState state = standstill(car, {Vec3(0.0), orientation_from_angles(0.0, slope_rad, 0.0)});
      DriverInput input = in_gear(1, 0.0, 1.0);
      input.brake = 1.0;
      drive(car, input, hill, 0.5, state);
      input.clutch = 0.0;
      drive(car, input, hill, 1.0, state);
      REQUIRE(!state.powertrain.engine_running);
      input.brake = 0.0;
      drive(car, input, hill, 3.0, state);
      const Vec3 settled_m = state.world_from_body.position_m;
      drive(car, input, hill, 10.0, state);
      const double way_m = glm::length(state.world_from_body.position_m - settled_m);
      if (grade < 0.2)
        CHECK(way_m < 0.02);
      else
        CHECK(way_m > 1.0);
    }
}
