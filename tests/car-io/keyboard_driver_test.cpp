#include "car-io/keyboard_driver.hpp"

#include <cmath>
#include <initializer_list>

#include <doctest/doctest.h>

namespace septet::car_io {
namespace {

constexpr double dt_s = 1.0 / 120.0;

DriverInput hold(KeyboardDriver& driver, const KeyStates& keys, double speed_mps, double time_s) {
  DriverInput input = driver.input;
  for (int i = 0; i < static_cast<int>(std::lround(time_s / dt_s)); ++i) input = advance(driver, keys, speed_mps, dt_s);
  return input;
}

}  // namespace

TEST_CASE(
    "full steering asks for the same lateral acceleration at any speed once the lock no longer "
    "limits") {
  const KeyboardSettings settings;
  for (const double speed_mps : {12.0, 20.0, 30.0, 50.0}) {
    const double road_wheel = largest_steering_rad(settings, speed_mps) / settings.steering_ratio;
    CHECK(speed_mps * speed_mps * std::tan(road_wheel) / settings.wheelbase_m ==
          doctest::Approx(settings.lateral_acceleration_mps2));
  }
  CHECK(largest_steering_rad(settings, 0.0) == settings.largest_angle_rad);
  CHECK(largest_steering_rad(settings, -3.0) <= settings.largest_angle_rad);
}

TEST_CASE("a steering key turns the wheel gradually and letting go straightens it") {
  KeyboardDriver driver;
  const KeyStates left{.left = true};
  const double full = largest_steering_rad(driver.settings, 25.0);
  CHECK(hold(driver, left, 25.0, 0.225).steering_wheel_rad == doctest::Approx(full / 2).epsilon(0.02));
  CHECK(hold(driver, left, 25.0, 0.5).steering_wheel_rad == doctest::Approx(full));
  CHECK(hold(driver, {}, 25.0, 0.3).steering_wheel_rad == 0.0);
  CHECK(hold(driver, {.right = true}, 25.0, 1.0).steering_wheel_rad == doctest::Approx(-full));
  CHECK(hold(driver, {.left = true, .right = true}, 25.0, 1.0).steering_wheel_rad == 0.0);
}

TEST_CASE("pedals rise and fall within their times") {
  KeyboardDriver driver;
  CHECK(hold(driver, {.accelerate = true}, 10.0, 0.175).accelerator == doctest::Approx(0.5).epsilon(0.03));
  CHECK(hold(driver, {.accelerate = true}, 10.0, 0.5).accelerator == 1.0);
  const DriverInput braking = hold(driver, {.brake = true}, 10.0, 0.5);
  CHECK(braking.accelerator == 0.0);
  CHECK(braking.brake == 1.0);
}

TEST_CASE("braking to a stop does not reverse but pressing the brake anew does") {
  KeyboardDriver driver;
  hold(driver, {.brake = true}, 5.0, 0.5);
  CHECK(hold(driver, {.brake = true}, 0.0, 2.0).selector == GearSelector::drive);
  hold(driver, {}, 0.0, 0.2);
  const DriverInput back = hold(driver, {.brake = true}, 0.0, 0.5);
  CHECK(back.selector == GearSelector::reverse);
  CHECK(back.accelerator == 1.0);
  CHECK(back.brake == 0.0);
  // Rolling backwards, the accelerator key brakes; at a standstill it drives on.
  CHECK(hold(driver, {.accelerate = true}, -3.0, 0.5).brake == 1.0);
  hold(driver, {}, 0.0, 0.1);
  CHECK(hold(driver, {.accelerate = true}, 0.0, 0.1).selector == GearSelector::drive);
}

TEST_CASE("a look key turns head and pictures to its side at once but not in a jump and lets them back") {
  KeyboardDriver driver;
  const KeyStates left{.look_left = true}, right{.look_right = true};
  const double aside = driver.settings.look_angle_rad;
  const DriverInput begun = hold(driver, left, 20.0, 2 * dt_s);
  CHECK(begun.gaze_heading_rad > 0.0);
  CHECK(begun.gaze_heading_rad < 0.2 * aside);
  const DriverInput there = hold(driver, left, 20.0, 0.3);
  CHECK(there.gaze_heading_rad == doctest::Approx(aside));
  CHECK(there.head.turn_rad == there.gaze_heading_rad);
  CHECK(hold(driver, {}, 20.0, 0.3).head.turn_rad == 0.0);
  CHECK(hold(driver, right, 20.0, 0.3).head.turn_rad == doctest::Approx(-aside));
  CHECK(hold(driver, {.look_left = true, .look_right = true}, 20.0, 0.5).head.turn_rad == 0.0);
}

TEST_CASE("an indicator key switches once per press") {
  KeyboardDriver driver;
  CHECK(hold(driver, {.indicator_left = true}, 10.0, 0.3).indicator == IndicatorStalk::left);
  hold(driver, {}, 10.0, 0.1);
  CHECK(hold(driver, {.indicator_right = true}, 10.0, 0.3).indicator == IndicatorStalk::right);
  hold(driver, {}, 10.0, 0.1);
  CHECK(hold(driver, {.indicator_right = true}, 10.0, 0.1).indicator == IndicatorStalk::off);
}

TEST_CASE("a gamepad stick has a dead zone and reaches the full angle and its triggers the pedals") {
  GamepadDriver driver;
  GamepadState pad;
  pad.left_stick_x = 0.1;
  CHECK(advance(driver, pad, 20.0, dt_s).steering_wheel_rad == 0.0);
  pad.left_stick_x = 1.0;
  pad.right_trigger = 1.0;
  pad.left_trigger = 0.0;
  DriverInput input;
  for (int i = 0; i < 120; ++i) input = advance(driver, pad, 20.0, dt_s);
  CHECK(input.steering_wheel_rad == doctest::Approx(-largest_steering_rad({}, 20.0)));
  CHECK(input.accelerator == 1.0);
  CHECK(input.brake == 0.5);
  pad.left_stick_x = std::nan("");
  pad.right_trigger = std::nan("");
  for (int i = 0; i < 120; ++i) input = advance(driver, pad, 20.0, dt_s);
  CHECK(input.steering_wheel_rad == 0.0);
  CHECK(input.accelerator == 0.0);
}

TEST_CASE("a gamepad reverses only at a standstill") {
  GamepadDriver driver;
  GamepadState pad;
  pad.reverse = true;
  CHECK(advance(driver, pad, 10.0, dt_s).selector == GearSelector::drive);
  pad.reverse = false;
  advance(driver, pad, 0.0, dt_s);
  pad.reverse = true;
  CHECK(advance(driver, pad, 0.0, dt_s).selector == GearSelector::reverse);
}

}  // namespace septet::car_io
