#include "car-io/actuator_guard.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "car-io/vibration_dose.hpp"
#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

constexpr double tick_s = 1.0 / 120.0;
constexpr Actuators driving{.fan = 0.8, .vibration = 0.4, .vibration_hz = 30.0, .steering = -0.6};

}  // namespace

TEST_CASE("after a fault everything is at zero within 200 ms and stays there until it is re-armed") {
  ActuatorGuard guard;
  CHECK(guard.pass(driving, tick_s).fan == 0.8);
  CHECK(guard.trip(true));
  double fan = 1.0;
  for (int tick = 0; tick < 24; ++tick) {
    const Actuators now = guard.pass(driving, tick_s);
    CHECK(now.fan < fan);
    fan = now.fan;
  }
  for (int tick = 0; tick < 600; ++tick) {
    CHECK_FALSE(guard.trip(tick < 300));
    const Actuators now = guard.pass(driving, tick_s);
    CHECK(now.fan < 1e-9);
    CHECK(now.vibration < 1e-9);
    CHECK(now.steering > -1e-9);
  }
  guard.rearm();
  CHECK(guard.pass(driving, tick_s).fan < 0.01);
  for (int tick = 0; tick < 120; ++tick) guard.pass(driving, tick_s);
  CHECK(guard.pass(driving, tick_s).steering == doctest::Approx(-0.6));
  CHECK(guard.trip(true));
}

TEST_CASE("a car that stands with its engine off is not at rest and a pause is") {
  CHECK(is_rest({}));
  CHECK_FALSE(is_rest({.vibration_hz = 5.0}));
  CHECK_FALSE(is_rest(driving));
}

TEST_CASE("frequencies weigh as ISO 2631-1 says") {
  // Table 3, Wk.
  const double table[][2] = {{1.0, 0.482}, {4.0, 0.967},  {5.0, 1.039},  {6.3, 1.054},
                             {8.0, 1.036}, {16.0, 0.768}, {31.5, 0.405}, {80.0, 0.132}};
  for (const auto& row : table) CHECK(std::abs(vertical_weight(row[0]) - row[1]) <= 0.001);
  CHECK(vertical_weight(0.0) == 0.0);
  CHECK(vertical_weight(-1.0) == 0.0);
}

TEST_CASE("an hour at 1.41 weighted is a day's action value") {
  VibrationDose dose;
  const double weight = vertical_weight(6.3);
  for (int second = 0; second < 3600; ++second)
    dose.add({.vibration = 0.5, .vibration_hz = 6.3}, 2.0 * 1.41421356 / weight, 1.0);
  CHECK(dose.a8_mps2() == relative(0.5, 1e-6));
  const double before = dose.a8_mps2();
  dose.add({.vibration = 1.0, .vibration_hz = 0.0}, 10.0, 3600.0);
  CHECK(dose.a8_mps2() == before);
}

}  // namespace septet::car_io
