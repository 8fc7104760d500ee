#include "car-io/car_report.hpp"

#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "car-io/car_layout.hpp"
#include "engine/core/random.hpp"
#include "tests/car-io/car_side.hpp"
#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

const CarLayout& layout_of(std::string_view name) { return **find_car_layout(name); }

/// Bits of each report in a descriptor, by main item (input 0x8, output 0x9, feature 0xb) and
/// report id: enough of HID 1.11, 6.2.2 for short items.
std::map<std::pair<int, int>, int> bits_of_reports(std::span<const std::uint8_t> descriptor) {
  std::map<std::pair<int, int>, int> bits;
  int size = 0, count = 0, id = 0;
  for (std::size_t i = 0; i < descriptor.size();) {
    const int prefix = descriptor[i], length = (prefix & 3) == 3 ? 4 : prefix & 3, tag = prefix >> 4,
              type = prefix >> 2 & 3;
    int value = 0;
    for (int k = 0; k < length; ++k) value |= descriptor[i + 1 + static_cast<std::size_t>(k)] << (8 * k);
    if (type == 1 && tag == 7) size = value;
    if (type == 1 && tag == 9) count = value;
    if (type == 1 && tag == 8) id = value;
    if (type == 0 && (tag == 8 || tag == 9 || tag == 11)) bits[{tag, id}] += size * count;
    i += 1 + static_cast<std::size_t>(length);
  }
  return bits;
}

DriverInput lively_input() {
  DriverInput input;
  input.steering_wheel_rad = -1.25;
  input.accelerator = 0.75;
  input.brake = 0.125;
  input.clutch = 1.0;
  input.selector = GearSelector::manual;
  input.gear = 6;
  input.indicator = IndicatorStalk::right;
  input.hazard_lights = true;
  input.horn = true;
  input.low_beam = false;
  input.high_beam = true;
  input.parking_brake = true;
  input.gaze_heading_rad = 0.7;
  input.sequence = 200;
  return input;
}

}  // namespace

TEST_CASE("the descriptor announces reports of exactly the sizes that are sent") {
  const auto bits = bits_of_reports(car_report_descriptor());
  CHECK(bits == std::map<std::pair<int, int>, int>{{{8, controls_report_id}, 8 * (controls_report_bytes - 1)},
                                                   {{9, actuators_report_id}, 8 * (actuators_report_bytes - 1)},
                                                   {{9, steering_report_id}, 8 * (steering_report_bytes - 1)},
                                                   {{11, device_report_id}, 8 * (device_report_bytes - 1)}});
}

TEST_CASE("controls go through a report and back within half a step of their field") {
  const DriverInput sent = lively_input();
  const auto report = encode_controls(sent);
  const auto read = decode_report(layout_of("septet-car"), {}, report);
  REQUIRE(read.has_value());
  CHECK(read->steering_wheel_rad == relative(sent.steering_wheel_rad, 1e-4));
  CHECK(std::abs(read->accelerator - sent.accelerator) <= 0.5 / 65535);
  CHECK(std::abs(read->brake - sent.brake) <= 0.5 / 65535);
  CHECK(std::abs(read->gaze_heading_rad - sent.gaze_heading_rad) < 1e-4);
  DriverInput rest = *read;
  rest.steering_wheel_rad = sent.steering_wheel_rad;
  rest.accelerator = sent.accelerator;
  rest.brake = sent.brake;
  rest.gaze_heading_rad = sent.gaze_heading_rad;
  CHECK(rest == sent);
}

TEST_CASE("a wheel turned to the left is negative in the report as joysticks have it") {
  DriverInput input;
  input.steering_wheel_rad = default_steering_lock_rad;
  const auto report = encode_controls(input);
  CHECK(report[1] == std::byte{0x01});
  CHECK(report[2] == std::byte{0x80});
  CHECK(decode_report(layout_of("septet-car"), {}, report)->steering_wheel_rad ==
        doctest::Approx(default_steering_lock_rad));
}

TEST_CASE("values beyond a field's range are taken to its end and bad numbers to zero") {
  DriverInput input;
  input.steering_wheel_rad = -100;
  input.accelerator = 2;
  input.brake = -1;
  input.clutch = std::nan("");
  const auto read = decode_report(layout_of("septet-car"), {}, encode_controls(input));
  CHECK(read->steering_wheel_rad == doctest::Approx(-default_steering_lock_rad));
  CHECK(read->accelerator == 1.0);
  CHECK(read->brake == 0.0);
  CHECK(read->clutch == 0.0);
}

TEST_CASE("short long and foreign reports are refused with one clear error") {
  const auto report = encode_controls(lively_input());
  const auto& layout = layout_of("septet-car");
  for (std::size_t size = 0; size < report.size(); ++size)
    CHECK_FALSE(decode_report(layout, {}, std::span(report).first(size)).has_value());
  Bytes longer(report.begin(), report.end());
  longer.push_back(std::byte{0});
  CHECK_FALSE(decode_report(layout, {}, longer).has_value());
  auto other_id = report;
  other_id[0] = std::byte{2};
  CHECK_FALSE(decode_report(layout, {}, other_id).has_value());
  auto bad_selector = report;
  bad_selector[11] = std::byte{0x15};
  const auto refused = decode_report(layout, {}, bad_selector);
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what == "its selector is 5 and its gear 0");
  CHECK(refused.error().remedy.find("REPORTS.md") != std::string::npos);
}

TEST_CASE("random bytes never give an input out of range in any layout") {
  Random random(3);
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes report(random.below(20));
    for (auto& byte : report) byte = static_cast<std::byte>(random.below(256));
    if (!report.empty() && trial % 2 == 0) report[0] = std::byte{1};
    for (const CarLayout& layout : car_layouts()) {
      const auto input = decode_report(layout, {}, report);
      if (!input) continue;
      ++accepted;
      REQUIRE(std::abs(input->steering_wheel_rad) <= default_steering_lock_rad);
      for (const double pedal : {input->accelerator, input->brake, input->clutch})
        REQUIRE((pedal >= 0.0 && pedal <= 1.0));
      REQUIRE(std::abs(input->gaze_heading_rad) <= 3.1416);
      REQUIRE((input->gear >= -1 && input->gear <= 6));
    }
  }
  CHECK(accepted > 100);
}

TEST_CASE("every field of every layout lies within its report") {
  for (const CarLayout& layout : car_layouts()) {
    for (const AxisField& axis : {layout.steering, layout.accelerator, layout.brake, layout.clutch})
      CHECK(axis.byte + axis.bits / 8u <= layout.report_bytes);
    for (const ButtonField& button : layout.buttons) CHECK(button.bit / 8u < layout.report_bytes);
    for (const auto& byte : {layout.selector_byte, layout.sequence_byte})
      if (byte) CHECK(*byte < layout.report_bytes);
    if (layout.head_byte) CHECK(*layout.head_byte + 2u <= layout.report_bytes);
  }
}

TEST_CASE("a Logitech G29 report reads as its layout says") {
  // Wheel a quarter to the right, accelerator half down, brake and clutch released, gear 3, L2 and
  // cross pressed.
  Bytes report(12, std::byte{0});
  const unsigned buttons = 1u << 4 | 1u << (4 + 7) | 1u << (4 + 14);
  for (std::size_t i = 0; i < 3; ++i) report[i] = static_cast<std::byte>(buttons >> (8 * i) & 0xff);
  report[4] = std::byte{0xff};
  report[5] = std::byte{0xbf};  // 49151: 0.5 of the way from the centre to full right.
  report[6] = std::byte{127};
  report[7] = report[8] = std::byte{255};
  rig::CarCalibration calibration;
  auto input = decode_report(layout_of("logitech-g29"), calibration, report);
  REQUIRE(input.has_value());
  CHECK(input->steering_wheel_rad == relative(-0.5 * default_steering_lock_rad, 1e-4));
  CHECK(input->accelerator == doctest::Approx(128.0 / 255));
  CHECK(input->brake == 0.0);
  CHECK(input->horn);
  CHECK(input->low_beam);
  CHECK(input->indicator == IndicatorStalk::left);
  CHECK(input->selector == GearSelector::drive);
  calibration.gear_lever = true;
  input = decode_report(layout_of("logitech-g29"), calibration, report);
  CHECK(input->selector == GearSelector::manual);
  CHECK(input->gear == 3);
}

TEST_CASE("who presses both indicators at once indicates nothing") {
  for (const auto& [buttons, expected] : {std::pair{1u << (4 + 6), IndicatorStalk::right},
                                          {1u << (4 + 7), IndicatorStalk::left},
                                          {1u << (4 + 6) | 1u << (4 + 7), IndicatorStalk::off},
                                          {0u, IndicatorStalk::off}}) {
    Bytes report(12, std::byte{0});
    for (std::size_t i = 0; i < 3; ++i) report[i] = static_cast<std::byte>(buttons >> (8 * i) & 0xff);
    const auto input = decode_report(layout_of("logitech-g29"), {}, report);
    REQUIRE(input.has_value());
    CHECK(input->indicator == expected);
  }
}

TEST_CASE("calibrated axes read 0 and 1 at their own ends and nothing in their dead zone") {
  rig::CarCalibration calibration;
  calibration.brake = {.min = 0.2, .max = 0.7};
  calibration.clutch = {.min = 0.0, .max = 1.0, .dead_zone = 0.1, .inverted = true};
  calibration.steering = {.min = -0.8, .centre = 0.1, .max = 0.9, .dead_zone = 0.05};
  const auto read = [&](double wheel, double brake, double clutch) {
    DriverInput input;
    input.steering_wheel_rad = wheel * default_steering_lock_rad;
    input.brake = brake;
    input.clutch = clutch;
    return *decode_report(layout_of("septet-car"), calibration, encode_controls(input));
  };
  CHECK(read(0, 0.1, 0).brake == 0.0);
  CHECK(read(0, 0.45, 0).brake == relative(0.5, 1e-3));
  CHECK(read(0, 0.8, 0).brake == 1.0);
  CHECK(read(0, 0, 1.0).clutch == 0.0);
  CHECK(read(0, 0, 0.92).clutch == 0.0);
  CHECK(read(0, 0, 0.0).clutch == 1.0);
  CHECK(read(0, 0, 0.45).clutch == relative(0.5, 1e-3));
  CHECK(read(0.1, 0, 0).steering_wheel_rad == doctest::Approx(0.0));
  CHECK(read(0.13, 0, 0).steering_wheel_rad == doctest::Approx(0.0));
  CHECK(read(0.95, 0, 0).steering_wheel_rad == doctest::Approx(default_steering_lock_rad));
  CHECK(read(-0.8, 0, 0).steering_wheel_rad == relative(-default_steering_lock_rad, 1e-3));
  calibration.steering.inverted = true;
  CHECK(read(0.9, 0, 0).steering_wheel_rad == relative(-default_steering_lock_rad, 1e-3));
}

TEST_CASE("the force of the hand wheel goes through its report and back") {
  for (const double force : {-1.0, -0.25, 0.0, 0.5, 1.0})
    CHECK(decode_steering(encode_steering(force, 3)).value() == doctest::Approx(force).epsilon(1e-3).scale(1.0));
  CHECK(encode_steering(1.0, 0)[2] == std::byte{0x80});  // To the left: negative, as the wheel.
  CHECK_FALSE(decode_steering(Bytes(3)).has_value());
}

TEST_CASE("an unknown layout is refused with the names that exist") {
  const auto layout = find_car_layout("gamepad");
  REQUIRE_FALSE(layout.has_value());
  CHECK(layout.error().remedy == "use one of: septet-car, logitech-g29");
}

TEST_CASE("actuators and device status go through their reports and back") {
  const auto actuators = decode_actuators(encode_actuators({.fan = 0.5, .vibration = 1.5, .vibration_hz = 45}, 7));
  REQUIRE(actuators.has_value());
  CHECK(actuators->fan == relative(0.5, 1e-4));
  CHECK(actuators->vibration == 1.0);
  CHECK(actuators->vibration_hz == 45);
  const auto status = decode_device_status(encode_device_status({.firmware = 0x0102, .watchdog_ms = 250}));
  REQUIRE(status.has_value());
  CHECK(status->firmware == 0x0102);
  CHECK(status->watchdog_ms == 250);
  CHECK_FALSE(decode_device_status(encode_actuators({}, 0)).has_value());
}

}  // namespace septet::car_io
