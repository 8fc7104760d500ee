// A learner at the keys of a car with a clutch: requests of the keys, and the car's behaviour.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "car-io/keyboard_driver.hpp"
#include "tests/engine/physics/vehicle/car.hpp"

namespace septet::car_io {
namespace {

using vehicle::Ground, vehicle::VehicleParameters, vehicle::VehicleState;

constexpr double tick_s = 1.0 / 120.0;

/// A driver at the keys of the manual S80.
struct Learner {
  VehicleParameters car = vehicle::read_car("volvo-s80-manual");
  Ground ground = vehicle::level_ground();
  VehicleState state = vehicle::standstill(car, {});
  KeyboardDriver driver;
  DriverInput input;

  static Learner on_hill(double grade) {
    Learner learner;
    const double slope_rad = -std::atan(grade);
    learner.ground = vehicle::sloping_ground(slope_rad);
    learner.state = vehicle::standstill(learner.car, {Vec3(0.0), orientation_from_angles(0.0, slope_rad, 0.0)});
    return learner;
  }
  double speed_mps() const { return vehicle::outputs(car, state).speed_mps; }
  void hold(const KeyStates& keys, double time_s) {
    for (int i = 0; i < static_cast<int>(std::lround(time_s / tick_s)); ++i) {
      input = advance(driver, keys, speed_mps(), tick_s);
      vehicle::drive(car, input, ground, tick_s, state);
    }
  }
  void press(KeyStates keys, bool KeyStates::*key) {
    keys.*key = true;
    hold(keys, 0.1);
    keys.*key = false;
    hold(keys, 0.1);
  }
  /// Standing on the brake, gears by hand, clutch down and first gear in.
  void into_first() {
    hold({.brake = true}, 0.5);
    press({.brake = true}, &KeyStates::manual);
    hold({.brake = true, .clutch = true}, 0.3);
    press({.brake = true, .clutch = true}, &KeyStates::gear_up);
    CHECK(state.powertrain.gear == 1);
    CHECK(state.powertrain.engine_running);
  }
};

}  // namespace

TEST_CASE("gears by hand are chosen at a standstill and left for drive again") {
  KeyboardDriver driver;
  const auto press = [&](bool KeyStates::*key, double speed_mps) {
    KeyStates keys;
    keys.*key = true;
    advance(driver, keys, speed_mps, tick_s);
    return advance(driver, {}, speed_mps, tick_s);
  };
  CHECK(press(&KeyStates::manual, 10.0).selector == GearSelector::drive);
  CHECK(press(&KeyStates::gear_up, 0.0).gear == 0);  // Only by hand.
  CHECK(press(&KeyStates::manual, 0.0).selector == GearSelector::manual);
  CHECK(press(&KeyStates::gear_up, 0.0).gear == 1);
  for (int i = 0; i < 9; ++i) press(&KeyStates::gear_up, 20.0);
  CHECK(driver.input.gear == driver.settings.gears);
  for (int i = 0; i < 12; ++i) press(&KeyStates::gear_down, 20.0);
  CHECK(driver.input.gear == -1);
  CHECK(press(&KeyStates::manual, 0.0).selector == GearSelector::drive);
  CHECK(press(&KeyStates::manual, 0.0).gear == 0);
}

TEST_CASE("with gears by hand the brake key brakes at a standstill and does not reverse") {
  KeyboardDriver driver;
  advance(driver, {.manual = true}, 0.0, tick_s);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 120; ++j) advance(driver, {.brake = true}, 0.0, tick_s);
    CHECK(driver.input.brake == 1.0);
    for (int j = 0; j < 60; ++j) advance(driver, {}, 0.0, tick_s);
  }
  CHECK(driver.input.selector == GearSelector::manual);
}

TEST_CASE("the parking brake stays set until it is released by the same key") {
  KeyboardDriver driver;
  CHECK(advance(driver, {.set_parking_brake = true}, 0.0, tick_s).parking_brake);
  for (int i = 0; i < 20; ++i) CHECK(advance(driver, {}, 0.0, tick_s).parking_brake);
  CHECK_FALSE(advance(driver, {.set_parking_brake = true}, 0.0, tick_s).parking_brake);
  CHECK(advance(driver, {.parking_brake = true}, 0.0, tick_s).parking_brake);
  CHECK_FALSE(advance(driver, {}, 0.0, tick_s).parking_brake);
}

TEST_CASE("who gives gas and lets the clutch come drives off and changes up") {
  Learner learner;
  learner.into_first();
  learner.hold({.accelerate = true, .clutch = true}, 0.3);
  learner.hold({.accelerate = true}, 4.0);
  CHECK(learner.state.powertrain.engine_running);
  CHECK(learner.speed_mps() > 4.0);
  learner.hold({.clutch = true}, 0.2);
  learner.press({.clutch = true}, &KeyStates::gear_up);
  learner.hold({.clutch = true}, 0.5);
  CHECK(learner.state.powertrain.gear == 2);
  learner.hold({.accelerate = true}, 3.0);
  CHECK(learner.state.powertrain.engine_running);
  CHECK(learner.speed_mps() > 8.0);
}

TEST_CASE("a lever moved without the clutch changes nothing until the clutch is down") {
  Learner learner;
  learner.into_first();
  learner.hold({.accelerate = true, .clutch = true}, 0.3);
  learner.hold({.accelerate = true}, 4.0);
  learner.press({.accelerate = true}, &KeyStates::gear_up);
  CHECK(learner.state.powertrain.gear == 1);
  learner.hold({.clutch = true}, 0.7);
  CHECK(learner.state.powertrain.gear == 2);
}

TEST_CASE("a clutch dropped in gear at idle stalls the engine and the clutch pressed again starts it") {
  Learner learner;
  learner.into_first();
  learner.hold({.brake = true}, 1.0);
  CHECK_FALSE(learner.state.powertrain.engine_running);
  learner.hold({.accelerate = true, .brake = true}, 1.0);
  CHECK_FALSE(learner.state.powertrain.engine_running);  // The accelerator alone does not start it.
  learner.hold({.brake = true, .clutch = true}, 1.0);
  CHECK(learner.state.powertrain.engine_running);
  CHECK(learner.state.powertrain.engine_radps > 0.7 * learner.car.powertrain.idle_radps);
}

TEST_CASE("on a hill a car with the clutch down and no brake rolls back and one with the parking brake does not") {
  Learner rolls = Learner::on_hill(0.10);
  rolls.into_first();
  rolls.hold({.clutch = true}, 2.0);
  CHECK(rolls.speed_mps() < -0.8);
  Learner held = Learner::on_hill(0.10);
  held.into_first();
  held.press({.brake = true, .clutch = true}, &KeyStates::set_parking_brake);
  held.hold({.clutch = true}, 2.0);
  CHECK(std::abs(held.speed_mps()) < 0.02);
}

TEST_CASE("a hill start against the parking brake goes uphill without rolling back") {
  Learner learner = Learner::on_hill(0.10);
  learner.into_first();
  learner.press({.brake = true, .clutch = true}, &KeyStates::set_parking_brake);
  learner.hold({.accelerate = true, .clutch = true}, 0.4);
  double least_mps = 0.0;
  const auto on = [&](const KeyStates& keys, double time_s) {
    for (double t = 0.0; t < time_s; t += tick_s) {
      learner.hold(keys, tick_s);
      least_mps = std::min(least_mps, learner.speed_mps());
    }
  };
  on({.accelerate = true}, 0.9);                             // The clutch bites,
  on({.accelerate = true, .set_parking_brake = true}, 0.1);  // the brake is released.
  on({.accelerate = true}, 3.0);
  CHECK(learner.state.powertrain.engine_running);
  CHECK(least_mps > -0.1);
  CHECK(learner.speed_mps() > 3.0);
}

}  // namespace septet::car_io
