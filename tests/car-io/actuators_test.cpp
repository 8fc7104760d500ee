#include "car-io/actuators.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::car_io {

TEST_CASE("the fan is off at rest and linear in the speed of the car up to full speed") {
  const rig::CarActuators limits{.fan_full_speed_mps = 40.0, .fan_least = 0.2, .fan_most = 1.0};
  const auto fan_at = [&](double speed_mps) { return actuators_for({.speed_mps = speed_mps}, limits).fan; };
  CHECK(fan_at(0.0) == 0.0);
  CHECK(fan_at(10.0) == doctest::Approx(0.4));
  CHECK(fan_at(20.0) == doctest::Approx(0.6));
  CHECK(fan_at(-20.0) == doctest::Approx(0.6));
  CHECK(fan_at(40.0) == doctest::Approx(1.0));
  CHECK(fan_at(80.0) == doctest::Approx(1.0));
}

TEST_CASE("no motion however wild takes an actuator beyond the limits of the rig") {
  const rig::CarActuators limits{.fan_most = 0.7, .vibration_most = 0.3, .steering_most = 0.5};
  const double wild[] = {0.0, -1.0, 1e9, std::nan(""), std::numeric_limits<double>::infinity()};
  for (const double a : wild)
    for (const double b : wild) {
      const Actuators out = actuators_for({.speed_mps = a,
                                           .engine_radps = b,
                                           .engine_load = a,
                                           .roughness = b,
                                           .anti_lock_active = true,
                                           .steering_torque_nm = a},
                                          limits);
      CHECK((out.fan >= 0.0 && out.fan <= 0.7));
      CHECK((out.vibration >= 0.0 && out.vibration <= 0.3));
      CHECK((out.vibration_hz >= 5.0 && out.vibration_hz <= 200.0));
      CHECK(std::abs(out.steering) <= 0.5);
    }
}

TEST_CASE("at idle the shaker plays the firing order and at speed the turning of the wheels") {
  const rig::CarActuators limits;
  const double idle_radps = 700.0 / 60.0 * 2.0 * std::numbers::pi;
  const auto idle = actuators_for({.engine_radps = idle_radps, .cylinders = 6}, limits);
  CHECK(idle.vibration_hz == doctest::Approx(35.0));
  const auto cruise =
      actuators_for({.speed_mps = 25.0, .engine_radps = 250.0, .wheel_radius_m = 0.31, .roughness = 1.0}, limits);
  CHECK(cruise.vibration_hz == relative(12.83, 0.01));
  CHECK(cruise.vibration > idle.vibration);
}

TEST_CASE("a fan whose air was measured blows air in proportion to the speed, or with a force in proportion to it") {
  rig::CarActuators limits{.fan_full_speed_mps = 40.0, .fan_curve = {{0.2, 1.0}, {0.5, 6.0}, {1.0, 10.0}}};
  const auto air_at = [&](double speed_mps) {
    const double duty = actuators_for({.speed_mps = speed_mps}, limits).fan;
    return duty < 0.5 ? 1.0 + 5.0 * (duty - 0.2) / 0.3 : 6.0 + 4.0 * (duty - 0.5) / 0.5;
  };
  for (const double speed_mps : {8.0, 20.0, 24.0, 36.0, 40.0, 70.0})
    CHECK(air_at(speed_mps) == doctest::Approx(10.0 * std::min(speed_mps / 40.0, 1.0)));
  CHECK(actuators_for({.speed_mps = 1.0}, limits).fan == doctest::Approx(0.2));
  limits.fan_follows = rig::CarActuators::Wind::force;
  for (const double speed_mps : {8.0, 20.0, 40.0})
    CHECK(std::pow(air_at(speed_mps) / 10.0, 2.0) == doctest::Approx(speed_mps / 40.0));
}

TEST_CASE("kerbs, crashes and lines are played at their own frequencies above engine and road") {
  const rig::CarActuators limits{.vibration_most = 1.0};
  const CarMotion driving{.speed_mps = 20.0, .engine_radps = 200.0, .engine_load = 0.5};
  CarMotion motion = driving;
  motion.on_line = true;
  CHECK(actuators_for(motion, limits).vibration_hz == doctest::Approx(20.0 / 0.3048));
  motion.bump = 0.8;
  CHECK(actuators_for(motion, limits).vibration_hz == doctest::Approx(13.0));
  CHECK(actuators_for(motion, limits).vibration > 0.7);
  motion.blow = 1.0;
  CHECK(actuators_for(motion, limits).vibration_hz == doctest::Approx(30.0));
  CHECK(actuators_for(motion, limits).vibration == 1.0);
  motion.bump = motion.blow = std::nan("");
  CHECK(actuators_for(motion, limits).vibration < 0.7);
}

TEST_CASE("a hand wheel without a motor gets no force") {
  CHECK(actuators_for({.steering_torque_nm = 5.0}, {}).steering == 0.0);
  CHECK(actuators_for({.steering_torque_nm = 4.0}, {.steering_full_nm = 8.0, .steering_most = 1.0}).steering ==
        doctest::Approx(0.5));
}

TEST_CASE("a road shakes with the root of the speed and in proportion to its roughness") {
  const rig::CarActuators limits{.vibration_most = 1.0};
  const auto shake = [&](double speed_mps, double roughness) {
    return actuators_for({.speed_mps = speed_mps, .roughness = roughness}, limits).vibration;
  };
  CHECK(shake(30.0, 2.0) == doctest::Approx(2.0 * shake(30.0, 1.0)));
  CHECK(shake(7.5, 1.0) == doctest::Approx(0.5 * shake(30.0, 1.0)));
  CHECK(shake(0.0, 1.0) == 0.0);
}

}  // namespace septet::car_io
