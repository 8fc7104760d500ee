#include "car-io/wheel_torque.hpp"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

namespace septet::car_io {
namespace {

constexpr double step_s = 1.0 / 120.0, full_nm = 8.0;

double settled_nm(const WheelMotion& motion) {
  WheelTorqueState state;
  double torque_nm = 0.0;
  for (int i = 0; i < 60; ++i) torque_nm = wheel_torque_nm(state, motion, full_nm, step_s);
  return torque_nm;
}

}  // namespace

TEST_CASE("on the move the column's torque is felt as it is up to the motor's limit") {
  CHECK(settled_nm({.column_torque_nm = 3.0, .wheel_rad = 0.5, .speed_mps = 20.0}) == doctest::Approx(3.0));
  CHECK(settled_nm({.column_torque_nm = -100.0, .wheel_rad = 0.5, .speed_mps = 20.0}) == doctest::Approx(-8.0));
}

TEST_CASE("a car that stands pulls its wheel to the middle and gently") {
  const double left_nm = settled_nm({.wheel_rad = 2.0});
  CHECK((left_nm < -1.0 && left_nm > -1.5));
  CHECK(settled_nm({.wheel_rad = -2.0}) == doctest::Approx(-left_nm));
  CHECK(settled_nm({.wheel_rad = 2.0, .speed_mps = 2.0}) == 0.0);
}

TEST_CASE("at the lock the wheel is pushed back with all there is whatever else pulls") {
  CHECK(settled_nm({.column_torque_nm = 8.0, .wheel_rad = 8.0, .speed_mps = 20.0}) == doctest::Approx(-8.0));
  CHECK(settled_nm({.column_torque_nm = -8.0, .wheel_rad = -8.0, .speed_mps = 20.0}) == doctest::Approx(8.0));
  CHECK(settled_nm({.wheel_rad = 7.7, .speed_mps = 20.0}) == 0.0);
}

TEST_CASE("no torque comes in a jolt and none is no number") {
  WheelTorqueState state;
  double before_nm = 0.0;
  const double wild[] = {1e9, -1e9, std::nan(""), std::numeric_limits<double>::infinity(), 0.0};
  for (const double torque : wild)
    for (const double angle : wild)
      for (const double speed : wild) {
        const double now_nm = wheel_torque_nm(
            state, {.column_torque_nm = torque, .wheel_rad = angle, .speed_mps = speed}, full_nm, step_s);
        CHECK(std::abs(now_nm - before_nm) <= full_nm * step_s / 0.05 + 1e-9);
        CHECK(std::abs(now_nm) <= full_nm);
        before_nm = now_nm;
      }
}

TEST_CASE("a wheel that is let go between its ends comes to rest") {
  // A wheel of 0.05 kg m2 under the motor alone, at standstill.
  WheelTorqueState state;
  double angle_rad = 3.0, rate_radps = 0.0;
  for (int i = 0; i < 120 * 20; ++i) {
    rate_radps += wheel_torque_nm(state, {.wheel_rad = angle_rad}, full_nm, step_s) / 0.05 * step_s;
    angle_rad += rate_radps * step_s;
    CHECK(std::abs(angle_rad) <= 3.01);
  }
  CHECK(std::abs(angle_rad) < 0.1);
}

}  // namespace septet::car_io
