#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/car_report.hpp"
#include "engine/core/random.hpp"
#include "tests/car-io/firmware/simulated_car.hpp"
#include "tests/checkout.hpp"
#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

constexpr int settled_ms = 60;

/// A car whose host has sent its first report, at rest, and the next one.
struct DrivenCar : SimulatedCar {
  DrivenCar() {
    run(settled_ms);
    tell({});
  }
  void tell(const Actuators& actuators, double steering = 0.0) {
    ++sequence;
    REQUIRE(take(encode_actuators(actuators, sequence)));
    REQUIRE(take(encode_steering(steering, sequence)));
  }
  void tell_for(int ms, const Actuators& actuators, double steering = 0.0) {
    for (int i = 0; i < ms; i += 10) {
      tell(actuators, steering);
      run(10);
    }
  }
  std::uint8_t sequence = 0;
};

}  // namespace

TEST_CASE("what the firmware packs the host's layout unpacks, and the reverse") {
  SimulatedCar car;
  CarConnection host(car.opener(), {});
  car.run(settled_ms);
  car.readings.steering = 16384;  // Half to the left of its own scale.
  car.readings.accelerator = 65535;
  car.readings.brake = 6554;
  car.readings.clutch = 32768;
  car.readings.buttons = 1u << 1 | 1u << 3 | 1u << 5 | 1u << 8;
  car.readings.selector = 4;
  car.readings.gear = 5;
  car.readings.head = -16384;
  car.run(settled_ms);
  const CarReading reading = host.poll(0.0);
  REQUIRE_FALSE(reading.is_stale);
  CHECK(reading.input.steering_wheel_rad == relative(0.5 * default_steering_lock_rad, 1e-4));
  CHECK(reading.input.accelerator == 1.0);
  CHECK(reading.input.brake == relative(0.1, 1e-4));
  CHECK(reading.input.clutch == relative(0.5, 1e-4));
  CHECK(reading.input.indicator == IndicatorStalk::right);
  CHECK(reading.input.horn);
  CHECK(reading.input.high_beam);
  CHECK_FALSE(reading.input.low_beam);
  CHECK(reading.input.selector == GearSelector::manual);
  CHECK(reading.input.gear == 4);
  CHECK(reading.input.gaze_heading_rad == relative(0.5 * std::numbers::pi, 1e-3));
  CHECK(reading.switches == CarSwitches{.emergency_stop = false, .rearm = true});
  CHECK(host.poll(0.01).input.sequence != reading.input.sequence);

  DrivenCar driven;
  driven.tell_for(2000, {.fan = 0.25, .vibration = 0.5, .vibration_hz = 41.0}, 1.0);
  CHECK(driven.outputs.fan == 16384);
  CHECK(driven.outputs.vibration == 32768);
  CHECK(driven.outputs.vibration_hz == 41);
  CHECK(driven.outputs.steering == -32767);  // To the left.
  CHECK(driven.outputs.fan_power);
  CHECK(decode_device_status((*driven.opener()().value()).get_feature(3, 5).value())->firmware ==
        SEPTET_FIRMWARE_VERSION);
}

TEST_CASE(
    "a host that falls silent or repeats itself is cut off after the watchdog's time and must begin at rest again") {
  for (const bool repeats : {false, true}) {
    DrivenCar car;
    car.tell_for(1500, {.fan = 1.0, .vibration = 1.0, .vibration_hz = 30.0}, 0.5);
    REQUIRE_FALSE(car.is_off());
    for (int ms = 0; ms < 240; ms += 10) {
      if (repeats) CHECK(car.take(encode_actuators({.fan = 1.0}, car.sequence)));
      car.run(10);
    }
    CHECK_FALSE(car.is_off());
    car.run(20);
    CHECK(car.is_off());
    car.tell_for(500, {.fan = 1.0, .vibration_hz = 30.0});
    CHECK(car.is_off());
    car.tell({});
    car.tell_for(500, {.fan = 1.0, .vibration_hz = 30.0});
    CHECK(car.outputs.fan > 20000);
    CHECK(car.outputs.fan < 45000);  // Half of the second that it takes.
  }
}

TEST_CASE("a report that comes before the first step after a long silence does not undo the silence") {
  DrivenCar car;
  const Actuators all{.fan = 1.0, .vibration = 1.0, .vibration_hz = 30.0};
  car.tell_for(1500, all, 0.5);
  REQUIRE_FALSE(car.is_off());
  car.now_ms += 10'000;  // Without a step.
  car.tell(all, 0.5);
  car.run(1);
  CHECK(car.is_off());
  CHECK(car.state() == SEPTET_HOST_SILENT);
  car.tell_for(20, {});
  car.tell_for(100, all);
  CHECK_FALSE(car.is_off());
}

TEST_CASE("after a reset everything is off until a report at rest comes, whatever else comes") {
  SimulatedCar car;
  car.run(settled_ms);
  for (std::uint8_t i = 1; i < 200; ++i) {
    CHECK(car.take(encode_actuators({.fan = 1.0, .vibration = 1.0, .vibration_hz = 30.0}, i)));
    CHECK(car.take(encode_steering(1.0, i)));
    car.run(10);
    REQUIRE(car.is_off());
  }
}

TEST_CASE("a report at rest beside a wheel that is still pulled arms nothing") {
  DrivenCar car;
  car.tell_for(200, {.fan = 1.0}, 0.5);
  car.readings.buttons = 1u << SEPTET_EMERGENCY_STOP_BIT;
  car.run(1);
  car.readings.buttons = 0;
  car.tell_for(500, {}, 0.5);  // A host that knows no stop, and whose car stands.
  CHECK(car.is_off());
  car.tell_for(20, {}, 0.0);
  CHECK_FALSE(car.is_off());
}

TEST_CASE("the parts list is what its lines come to and less than the paper's 20 000 euros") {
  std::ifstream readme(source_folder() + "/car-io/firmware/README.md");
  const auto number = [](std::string text) {
    std::erase_if(text, [](char c) { return c < '0' || c > '9'; });
    return text.empty() ? 0 : std::stoi(text);
  };
  int sum = 0, said = 0, parts = 0;
  for (std::string line; std::getline(readme, line);) {
    std::vector<std::string> cells;
    for (std::size_t at = 1; line.starts_with('|') && at < line.size();) {
      const std::size_t end = line.find('|', at);
      if (end == std::string::npos) break;
      cells.push_back(line.substr(at, end - at));
      at = end + 1;
    }
    if (cells.size() != 4) continue;
    if (cells[3].find("**") != std::string::npos) said = number(cells[3]);
    if (number(cells[1]) == 0 || number(cells[2]) == 0) continue;
    CHECK_MESSAGE(number(cells[1]) * number(cells[2]) == number(cells[3]), line);
    sum += number(cells[3]);
    ++parts;
  }
  CHECK(parts >= 12);
  CHECK(sum == said);
  CHECK(sum < 20000);
}

TEST_CASE("an emergency stop is off within a millisecond, is told to the host, and lasts until a report at rest") {
  DrivenCar car;
  CarConnection host(car.opener(), {});
  car.tell_for(1500, {.fan = 1.0, .vibration = 1.0, .vibration_hz = 30.0}, 0.5);
  car.readings.buttons = 1u << SEPTET_EMERGENCY_STOP_BIT;
  car.run(1);
  CHECK(car.is_off());
  CHECK(host.poll(0.0).switches.emergency_stop);
  car.readings.buttons = 0;
  car.run(20);
  CHECK(host.poll(0.1).switches.emergency_stop);  // Contacts bounce.
  car.tell_for(500, {.fan = 1.0, .vibration_hz = 30.0});
  CHECK_FALSE(host.poll(0.2).switches.emergency_stop);
  CHECK(car.is_off());
  car.tell({});
  car.tell_for(100, {.fan = 1.0, .vibration_hz = 30.0});
  CHECK_FALSE(car.is_off());
}

TEST_CASE("a car whose emergency stop is not wired is stopped from the beginning") {
  SimulatedCar car;
  car.readings.buttons = 1u << SEPTET_EMERGENCY_STOP_BIT;  // An open contact, as a broken wire is one.
  car.run(500);
  CHECK(car.take(encode_actuators({}, 1)));
  CHECK(car.take(encode_actuators({.fan = 1.0, .vibration_hz = 5.0}, 2)));
  car.run(100);
  CHECK(car.is_off());
}

TEST_CASE("a bouncing contact is one press, and one that is touched for a moment none") {
  SimulatedCar car;
  car.run(settled_ms);
  int presses = 0;
  bool was_down = false;
  const auto hold = [&](bool down, int ms) {
    car.readings.buttons = down ? 1u << 3 : 0u;
    for (int i = 0; i < ms; ++i) {
      car.run(1);
      const bool is_down = (car.device.now.buttons & 1u << 3) != 0;
      presses += is_down && !was_down ? 1 : 0;
      was_down = is_down;
    }
  };
  hold(true, 3);
  hold(false, 40);
  CHECK(presses == 0);
  for (int i = 0; i < 6; ++i) hold(i % 2 == 0, 2);
  hold(true, 30);
  for (int i = 0; i < 6; ++i) hold(i % 2 == 0, 2);
  hold(false, 40);
  CHECK(presses == 1);
  CHECK_FALSE(was_down);
}

TEST_CASE("axes reach both ends from whatever converter, either way round, and no reading leaves them") {
  const septet_axis wheel{.at_least = 200, .at_centre = 2000, .at_most = 4000, .dead_zone = 10};
  CHECK(septet_wheel(&wheel, 2000) == 0);
  CHECK(septet_wheel(&wheel, 2010) == 0);
  CHECK(septet_wheel(&wheel, 4000) == -32767);
  CHECK(septet_wheel(&wheel, 200) == 32767);
  CHECK(septet_wheel(&wheel, 3005) == -16384);
  const septet_axis turned{.at_least = 4000, .at_centre = 2000, .at_most = 200, .dead_zone = 10};
  CHECK(septet_wheel(&turned, 200) == -32767);
  CHECK(septet_wheel(&turned, 4095) == 32767);
  const septet_axis pedal{.at_least = 3000, .at_centre = 0, .at_most = 500, .dead_zone = 100};
  CHECK(septet_pedal(&pedal, 3000) == 0);
  CHECK(septet_pedal(&pedal, 2900) == 0);
  CHECK(septet_pedal(&pedal, 500) == 65535);
  CHECK(septet_pedal(&pedal, 1700) == 32768);
  const septet_axis broken{.at_least = 7, .at_centre = 7, .at_most = 7, .dead_zone = 0};
  constexpr std::int32_t least = std::numeric_limits<std::int32_t>::min(),
                         most = std::numeric_limits<std::int32_t>::max();
  for (const std::int32_t raw : {least, 0, 7, 8, most}) {
    CHECK(septet_wheel(&broken, raw) == 0);
    CHECK(septet_pedal(&broken, raw) == 0);
    for (const septet_axis* axis : {&wheel, &turned, &pedal}) {
      CHECK(std::abs(septet_wheel(axis, raw)) <= 32767);
      CHECK(septet_pedal(axis, raw) <= 65535);
    }
  }
}

TEST_CASE("reports that are none, and a watchdog of nothing or of ages, change nothing") {
  DrivenCar car;
  Random random(7);
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes(static_cast<std::size_t>(random.uniform() * 12.0));
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(static_cast<unsigned>(random.uniform() * 256.0));
    if (!bytes.empty() && (bytes.size() == 7 || bytes.size() == 4) && bytes[0] > std::byte{1}) bytes[0] = std::byte{9};
    car.take(bytes);
    car.run(1);
  }
  CHECK(car.is_off());
  CHECK(car.device.watchdog_ms > 0);
  CHECK(car.device.watchdog_ms <= SEPTET_LONGEST_WATCHDOG_MS);
  CHECK_FALSE(car.take(encode_device_status({.watchdog_ms = 0})));
  CHECK_FALSE(car.take(encode_device_status({.watchdog_ms = 60000})));
  CHECK(car.take(encode_device_status({.watchdog_ms = 100})));
  CHECK(car.device.watchdog_ms == 100);
}

TEST_CASE("the host's writer sets the watchdog and finds it kept") {
  SimulatedCar car;
  car.device.watchdog_ms = 7;
  car.run(settled_ms);
  {
    ActuatorWriter writer(car.opener(), {.period_s = 0.001, .silent_after_s = 60.0});
    for (int i = 0; i < 100'000 && car.state() != SEPTET_RUNS; ++i) car.run(0);
    CHECK_FALSE(writer.take_error().has_value());
  }
  CHECK(car.device.watchdog_ms == 250);
  CHECK(car.device.state == SEPTET_RUNS);
}

TEST_CASE("the shaker's wave has its frequency and size and does not jump when the frequency does") {
  septet_outputs outputs{};
  outputs.amplifier_power = true;
  outputs.vibration = 65535;
  outputs.vibration_hz = 50;
  int crossings = 0, largest = 0, largest_step = 0, before = 0;
  for (int i = 0; i < 8000; ++i) {
    if (i == 4000) outputs.vibration_hz = 20;
    const int sample = septet_vibration_sample(&outputs, 4000);
    crossings += before < 0 && sample >= 0 ? 1 : 0;
    largest = std::max(largest, std::abs(sample));
    largest_step = std::max(largest_step, std::abs(sample - before));
    before = sample;
  }
  CHECK(crossings == relative(70, 0.02));
  CHECK(largest == relative(32767, 0.001));
  CHECK(largest_step < 1.02 * 32767 * 2.0 * std::numbers::pi * 50.0 / 4000.0);
  outputs.amplifier_power = false;
  CHECK(septet_vibration_sample(&outputs, 4000) == 0);
}

}  // namespace septet::car_io
