#include "car-io/program/calibration.hpp"

#include <doctest/doctest.h>

#include "tests/why_not.hpp"

namespace septet::car_io {
namespace {

std::string rig_with(const std::string& calibration) {
  return "name = \"r\"\neye_point_m = [1.35, 0.37, 1.17]\n[car]\nsource = \"hid\"\n" + calibration +
         "[[screen]]\nname = \"a\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, "
         "0]\nupper_left_m = [2, 1, 1]\n";
}

/// A wheel that stands a little to the left and reaches 0.9; a brake that counts down from 0.8.
CalibrationRecord moved_car() {
  CalibrationRecord record;
  record.add({.steering = 0.05, .accelerator = 0.02, .brake = 0.8, .clutch = 0.0});
  for (int i = 0; i <= 100; ++i)
    record.add({.steering = -0.9 + 0.018 * i,
                .accelerator = 0.02 + 0.009 * i,
                .brake = 0.8 - 0.006 * i,
                .clutch = 0.0005 * i});
  return record;
}

}  // namespace

TEST_CASE("a recording finds ends centre and direction and names what nobody moved") {
  const auto recorded = calibration_of(moved_car(), {});
  CHECK(recorded.unmoved == "clutch");
  const auto& calibration = recorded.calibration;
  CHECK(calibration.steering.min == doctest::Approx(-0.9));
  CHECK(calibration.steering.centre == doctest::Approx(0.05));
  CHECK(calibration.steering.max == doctest::Approx(0.9));
  CHECK(calibration.accelerator.min == doctest::Approx(0.02));
  CHECK(calibration.accelerator.max == doctest::Approx(0.92));
  CHECK_FALSE(calibration.accelerator.inverted);
  CHECK(calibration.brake.min == doctest::Approx(0.2));
  CHECK(calibration.brake.inverted);
  CHECK(calibration.clutch.max == 1.0);
}

TEST_CASE("what calibrate prints is what a rig reads") {
  const auto calibration = calibration_of(moved_car(), {}).calibration;
  const auto rig = rig::read_rig(rig_with(calibration_toml(calibration)), "printed");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  CHECK(rig->car.calibration.steering.centre == doctest::Approx(0.05));
  CHECK(rig->car.calibration.brake.inverted);
  CHECK(rig->car.calibration.brake.max == doctest::Approx(0.8));
  CHECK(rig->car.calibration.accelerator.dead_zone == doctest::Approx(0.02));
}

TEST_CASE("a calibration that would divide by zero is refused with its line") {
  const auto refused = [&](const std::string& text) {
    const auto rig = rig::read_rig(rig_with("[car.calibration]\n" + text + "\n"), "wrong");
    REQUIRE_FALSE(rig.has_value());
    CHECK(rig.error().where.starts_with("wrong:6:"));
    return rig.error().what;
  };
  CHECK(refused("brake = { min = 0.7, max = 0.7 }") == "the brake's max is not above its min by 0.05 or more");
  CHECK(refused("steering = { min = -1.0, centre = 1.0, max = 1.0 }") ==
        "the steering's centre does not lie between min and max");
  CHECK(refused("brake = { centre = 0.1 }") == "car.calibration.brake has no key \"centre\"");
}

}  // namespace septet::car_io
