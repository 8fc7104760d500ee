#include "car-io/keyboard_driver.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <initializer_list>
#include <utility>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

constexpr double dt_s = 1.0 / 120.0;

DriverInput hold(KeyboardDriver& driver, const KeyStates& keys, double speed_mps, double time_s) {
  DriverInput input = driver.input;
  for (int i = 0; i < static_cast<int>(std::lround(time_s / dt_s)); ++i) input = advance(driver, keys, speed_mps, dt_s);
  return input;
}

/// A driver used to a keyboard follows a line, straight or bent, from 0.8 m beside it, sees where the car was a quarter
/// of a second ago, and decides eight times a second: a key that would turn the car to where it should go, or none.
/// Returns the farthest from the line in the last twenty of forty seconds, of a car that goes where its front wheels
/// point.
double wandering_m(double speed_mps, double curvature_per_m = 0.0) {
  constexpr int seen_late_ticks = 30, decided_every_ticks = 15;
  KeyboardDriver driver;
  const KeyboardSettings& settings = driver.settings;
  struct Car {
    double aside_m = 0.8, heading_rad = 0.0, wheel_rad = 0.0;
  } car;
  std::deque<Car> seen(seen_late_ticks, car);
  KeyStates keys;
  double farthest_m = 0.0;
  for (int tick = 0; tick < 40 * 120; ++tick) {
    if (tick % decided_every_ticks == 0) {
      const Car& was = seen.front();
      const double ahead_m = std::max(6.0, 1.5 * speed_mps);
      const double bearing_rad =
          std::atan2(ahead_m * ahead_m * curvature_per_m / 2.0 - was.aside_m, ahead_m) - was.heading_rad;
      const double wished_rad =
          settings.steering_ratio * std::atan(2.0 * settings.wheelbase_m * std::sin(bearing_rad) / ahead_m);
      const double wrong_by_rad = wished_rad - was.wheel_rad,
                   clearly = 0.05 * largest_steering_rad(settings, speed_mps);
      keys = {.left = wrong_by_rad > clearly, .right = wrong_by_rad < -clearly};
    }
    car.wheel_rad = advance(driver, keys, speed_mps, dt_s).steering_wheel_rad;
    const double turned_per_m = std::tan(car.wheel_rad / settings.steering_ratio) / settings.wheelbase_m;
    car.heading_rad += speed_mps * (turned_per_m - curvature_per_m) * dt_s;  // Against the line's.
    car.aside_m += speed_mps * std::sin(car.heading_rad) * dt_s;
    seen.pop_front();
    seen.push_back(car);
    if (tick >= 20 * 120) farthest_m = std::max(farthest_m, std::abs(car.aside_m));
  }
  return farthest_m;
}

}  // namespace

TEST_CASE("who taps keys keeps the car within its lane at a walk's pace as on a country road") {
  for (const double speed_mps : {2.0, 4.0, 5.0, 7.0, 10.0, 15.0, 20.0, 25.0, 30.0}) {
    INFO("m/s: " << speed_mps);
    CHECK(wandering_m(speed_mps) < 0.4);
  }
}

TEST_CASE("who taps keys keeps the car within its lane through the bends of a country road") {
  struct Bend {
    double speed_mps, radius_m;
  };
  for (const Bend bend : {Bend{12.0, 250.0}, Bend{16.0, 160.0}, Bend{16.0, 220.0}, Bend{20.0, 400.0}}) {
    INFO(bend.speed_mps << " m/s, " << bend.radius_m << " m");
    CHECK(wandering_m(bend.speed_mps, 1.0 / bend.radius_m) < 0.8);
  }
}

TEST_CASE("a hand turns the wheel no faster at a walk's pace than hands do") {
  for (const double speed_mps : {0.0, 1.0, 5.0, 8.0}) {
    INFO("m/s: " << speed_mps);
    KeyboardDriver driver;
    double before_rad = 0.0;
    const auto turned_rad = [&](const KeyStates& keys) {
      const double now_rad = advance(driver, keys, speed_mps, dt_s).steering_wheel_rad;
      return std::abs(now_rad - std::exchange(before_rad, now_rad));
    };
    for (int i = 0; i < 240; ++i) CHECK(turned_rad({.left = true}) <= driver.settings.hand_speed_radps * dt_s + 1e-12);
    CHECK(before_rad == largest_steering_rad(driver.settings, speed_mps));
    for (int i = 0; i < 120; ++i) CHECK(turned_rad({}) <= driver.settings.return_speed_radps * dt_s + 1e-12);
    CHECK(before_rad == 0.0);
  }
}

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

TEST_CASE("a steering key turns the wheel slowly, then faster, and letting go straightens it") {
  KeyboardDriver driver;
  const KeyStates left{.left = true};
  const double full = largest_steering_rad(driver.settings, 25.0);
  CHECK(hold(driver, left, 25.0, 0.1).steering_wheel_rad < 0.06 * full);
  CHECK(hold(driver, left, 25.0, 0.3).steering_wheel_rad == relative(0.46 * full, 0.02));
  CHECK(hold(driver, left, 25.0, 0.3).steering_wheel_rad == full);
  CHECK(hold(driver, {}, 25.0, 0.05).steering_wheel_rad > 0.9 * full);
  CHECK(hold(driver, {}, 25.0, 0.4).steering_wheel_rad == 0.0);
  CHECK(hold(driver, {.right = true}, 25.0, 1.0).steering_wheel_rad == doctest::Approx(-full));
  CHECK(hold(driver, {.left = true, .right = true}, 25.0, 1.0).steering_wheel_rad == 0.0);
}

TEST_CASE("pedals rise and fall within their times") {
  KeyboardDriver driver;
  CHECK(hold(driver, {.accelerate = true}, 10.0, 0.175).accelerator == relative(0.5, 0.03));
  CHECK(hold(driver, {.accelerate = true}, 10.0, 0.5).accelerator == 1.0);
  const DriverInput braking = hold(driver, {.brake = true}, 10.0, 0.4);
  CHECK(braking.accelerator == 0.0);
  CHECK(braking.brake == relative(0.33, 0.05));
  CHECK(hold(driver, {.brake = true}, 10.0, 0.4).brake == 1.0);
}

TEST_CASE(
    "a tap brakes gently, also where a picture takes long, and a brake let go is pressed anew from the beginning") {
  for (const double step_s : {dt_s, 1.0 / 60.0, 0.15}) {
    INFO("step, s: " << step_s);
    KeyboardDriver driver;
    const auto press = [&](bool brake, double time_s) {
      for (int i = 0; i < static_cast<int>(std::lround(time_s / step_s)); ++i)
        advance(driver, {.brake = brake}, 10.0, step_s);
      return driver.input.brake;
    };
    for (int tap = 0; tap < 3; ++tap) {
      CHECK(press(true, 0.15) < 0.15);
      CHECK(press(false, 0.15) == 0.0);
    }
  }
}

TEST_CASE("braking to a stop does not reverse but pressing the brake anew does") {
  KeyboardDriver driver;
  hold(driver, {.brake = true}, 5.0, 1.0);
  CHECK(hold(driver, {.brake = true}, 0.0, 2.0).selector == GearSelector::drive);
  hold(driver, {}, 0.0, 0.2);
  const DriverInput back = hold(driver, {.brake = true}, 0.0, 0.5);
  CHECK(back.selector == GearSelector::reverse);
  CHECK(back.accelerator == 1.0);
  CHECK(back.brake == 0.0);
  // Rolling backwards, the accelerator key brakes; at a standstill it drives on.
  CHECK(hold(driver, {.accelerate = true}, -3.0, 0.8).brake == 1.0);
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
