#include "car-io/car_connection.hpp"

#include <doctest/doctest.h>

#include "car-io/relayed_device.hpp"
#include "car-io/simulated_hid_device.hpp"
#include "tests/relative.hpp"

namespace septet::car_io {
namespace {

Bytes report_of(double accelerator, std::uint8_t sequence) {
  DriverInput input;
  input.accelerator = accelerator;
  input.steering_wheel_rad = 0.5;
  input.brake = 0.25;
  input.horn = true;
  input.sequence = sequence;
  const auto report = encode_controls(input);
  return {report.begin(), report.end()};
}

}  // namespace

TEST_CASE("the newest of the waiting reports decides and is handed over as it was read") {
  SimulatedHidPort port;
  port.plug();
  CarConnection car(port.opener(), {});
  port.send(report_of(0.1, 1));
  port.send(report_of(0.9, 2));
  CarReading reading = car.poll(0.0);
  CHECK(reading.is_connected);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.accelerator == relative(0.9, 1e-4));
  CHECK(reading.report == report_of(0.9, 2));
  reading = car.poll(0.008);
  CHECK_FALSE(reading.report.has_value());
  CHECK(reading.input.accelerator == relative(0.9, 1e-4));
}

TEST_CASE(
    "a sequence that stands still for more than 100 ms releases accelerator and horn and keeps the "
    "rest") {
  SimulatedHidPort port;
  port.plug();
  CarConnection car(port.opener(), {});
  port.send(report_of(0.8, 5));
  CHECK_FALSE(car.poll(1.0).is_stale);
  port.send(report_of(0.8, 5));  // The host talks, the car's clockwork stands still.
  CHECK_FALSE(car.poll(1.09).is_stale);
  const CarReading stale = car.poll(1.101);
  CHECK(stale.is_stale);
  CHECK(stale.is_connected);
  CHECK(stale.input.accelerator == 0.0);
  CHECK_FALSE(stale.input.horn);
  CHECK(stale.input.brake == relative(0.25, 1e-4));
  CHECK(stale.input.steering_wheel_rad == relative(0.5, 1e-3));
  port.send(report_of(0.8, 6));
  const CarReading fresh = car.poll(1.2);
  CHECK_FALSE(fresh.is_stale);
  CHECK(fresh.input.accelerator == relative(0.8, 1e-4));
}

TEST_CASE("a car that was never there is stale and says why once") {
  SimulatedHidPort port;
  CarConnection car(port.opener(), {});
  const CarReading reading = car.poll(0.0);
  CHECK(reading.is_stale);
  CHECK(reading.input.accelerator == 0.0);
  REQUIRE(car.take_error().has_value());
  car.poll(10.0);
  CHECK_FALSE(car.take_error().has_value());
}

TEST_CASE("an unplugged car is stale at once and comes back by itself after replugging") {
  SimulatedHidPort port;
  port.plug();
  CarConnection car(port.opener(), {});
  port.send(report_of(0.8, 1));
  CHECK(car.poll(0.0).is_connected);
  port.unplug();
  CarReading reading = car.poll(0.01);
  CHECK_FALSE(reading.is_connected);
  CHECK(reading.is_stale);
  CHECK(reading.input.accelerator == 0.0);
  CHECK(car.take_error().value().what == "no such device");
  port.plug();
  port.send(report_of(0.6, 1));
  CHECK_FALSE(car.poll(0.3).is_connected);  // Not before the next try.
  reading = car.poll(0.51);
  CHECK(reading.is_connected);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.accelerator == relative(0.6, 1e-4));
}

TEST_CASE("refused reports are counted and change nothing") {
  SimulatedHidPort port;
  port.plug();
  CarConnection car(port.opener(), {});
  port.send(report_of(0.8, 1));
  car.poll(0.0);
  port.send(Bytes(3, std::byte{1}));
  const CarReading reading = car.poll(0.01);
  CHECK(car.refused_reports() == 1);
  CHECK(reading.input.accelerator == relative(0.8, 1e-4));
  CHECK(car.take_error().value().what == "it has 3 bytes where 15 belong");
  for (int i = 0; i < 20; ++i) {
    port.send(Bytes(3, std::byte{1}));
    car.poll(0.02 + 0.01 * i);
  }
  CHECK(car.refused_reports() == 21);
  CHECK(car.poll(0.3).is_stale);
}

TEST_CASE("the simulated port keeps the oldest reports as the kernel does") {
  SimulatedHidPort port;
  port.plug();
  auto device = port.open().value();
  for (int i = 0; i < 100; ++i) CHECK(port.send(Bytes(1, static_cast<std::byte>(i))) == (i < 63));
  CHECK(device->read_newest().value().value() == Bytes(1, std::byte{62}));
  CHECK_FALSE(device->read_newest().value().has_value());
}

TEST_CASE("a device held over a replug stays dead") {
  SimulatedHidPort port;
  port.plug();
  const auto old = port.open().value();
  port.plug();
  CHECK_FALSE(old->read_newest().has_value());
  CHECK_FALSE(old->write(Bytes(7)).has_value());
  CHECK_FALSE(old->get_feature(3, 5).has_value());
  CHECK(port.open().value()->read_newest().has_value());
}

TEST_CASE("output and feature reports reach the device") {
  SimulatedHidPort port;
  port.plug();
  const auto device = port.open().value();
  REQUIRE(device->write(encode_actuators({.fan = 1.0}, 1)));
  REQUIRE(port.take_written().size() == 1);
  REQUIRE(device->send_feature(encode_device_status({.firmware = 0, .watchdog_ms = 300})));
  CHECK(decode_device_status(device->get_feature(device_report_id, device_report_bytes).value())->watchdog_ms == 300);
}

TEST_CASE("a far device is read like a near one and what was overtaken on the way does not count") {
  RelayedDevice far;
  CarConnection car(far.opener(), {.repeats = true});
  CHECK_FALSE(car.poll(0.0).is_connected);
  CHECK(car.take_error()->what == "septet-car has not connected yet");
  far.receive(7, report_of(0.5, 1), "");
  CHECK(car.poll(1.0).input.accelerator == relative(0.5, 1e-4));
  far.receive(6, report_of(0.9, 0), "");
  CHECK(car.poll(1.01).input.accelerator == relative(0.5, 1e-4));
  far.receive(8, {}, "reading failed: No such device");
  const CarReading away = car.poll(1.02);
  CHECK_FALSE(away.is_connected);
  CHECK(away.is_stale);
  CHECK(away.input.accelerator == 0.0);
  CHECK(car.take_error()->what == "reading failed: No such device");
  far.receive(9, report_of(0.7, 2), "");
  CHECK(car.poll(2.0).input.accelerator == relative(0.7, 1e-4));
  far.lose("");
  CHECK(car.poll(2.01).is_stale);
}

TEST_CASE("a far wheel without a sequence is stale when nothing comes for 100 ms") {
  RelayedDevice far;
  CarConnection car(far.opener(), {.layout = *find_car_layout("logitech-g29"), .repeats = true});
  Bytes report(12, std::byte{0});
  far.receive(1, report, "");
  CHECK_FALSE(car.poll(0.0).is_stale);
  CHECK_FALSE(car.poll(0.09).is_stale);
  CHECK(car.poll(0.11).is_stale);
  far.receive(2, report, "");
  CHECK_FALSE(car.poll(0.12).is_stale);
}

}  // namespace septet::car_io
