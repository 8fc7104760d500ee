// An artificial HID device (uhid), as hidraw and evdev show it: reports that a good firmware never sends.

#include <linux/input-event-codes.h>
#include <linux/input.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>

#include <doctest/doctest.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/car_report.hpp"
#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "tests/car-io/car_side.hpp"
#include "tests/relative.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/uhid_device.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

/// A car whose reports may be any bytes.
class UserSpaceCar {
 public:
  explicit UserSpaceCar(const char* serial)
      : device_({"Septet car", serial, car_report_descriptor(), 0x1209, 0x0001},
                {[this](std::span<const std::byte> report) { take(report); },
                 [this](std::span<const std::byte> report) { return set_watchdog(report); },
                 [this] { return status(); }}) {}

  void send(std::span<const std::byte> report) { device_.send(report); }
  void send(double accelerator, std::uint8_t sequence) {
    DriverInput input;
    input.accelerator = accelerator;
    input.sequence = sequence;
    send(encode_controls(input));
  }

  /// Its reply to a setting of its watchdog.
  enum class Watchdog : std::uint8_t { keeps, forgets, refuses };
  std::atomic<Watchdog> watchdog = Watchdog::keeps;

  double fan() {
    const std::lock_guard lock(mutex_);
    return fan_;
  }

 private:
  void take(std::span<const std::byte> report) {
    const std::lock_guard lock(mutex_);
    if (const auto actuators = decode_actuators(report)) fan_ = actuators->fan;
  }
  int set_watchdog(std::span<const std::byte> report) {
    const std::lock_guard lock(mutex_);
    const auto status = decode_device_status(report);
    if (status && watchdog == Watchdog::keeps) status_ = *status;
    return watchdog == Watchdog::refuses ? EIO : 0;
  }
  Bytes status() {
    const std::lock_guard lock(mutex_);
    const auto report = encode_device_status(status_);
    return {report.begin(), report.end()};
  }

  std::mutex mutex_;  ///< Guards the members below.
  DeviceStatus status_{.firmware = 1, .watchdog_ms = 1000};
  double fan_ = -1.0;
  UhidDevice device_;  ///< Last: it answers with the others.
};

OpenHidDevice opener(const char* serial) {
  return [address = HidAddress{.serial = serial}] { return open_hid_device(address); };
}

std::unique_ptr<HidDevice> opened(const char* serial) {
  std::unique_ptr<HidDevice> device;
  CHECK(becomes_true([&] {
    auto tried = opener(serial)();
    if (tried) device = std::move(*tried);
    return device != nullptr;
  }));
  REQUIRE(device);
  return device;
}

}  // namespace

TEST_SUITE_BEGIN("hid");

TEST_CASE("a tick that comes late finds the kernel's oldest reports and the next one the newest") {
  UserSpaceCar car("U-1");
  const auto device = opened("U-1");
  for (int i = 0; i < 200; ++i) car.send(i / 200.0, static_cast<std::uint8_t>(i));
  const auto late = device->read_newest();
  REQUIRE((late && *late));
  const int sequence = decode_report(car_layouts().front(), {}, **late).value().sequence;
  measured("reports that the kernel keeps of 200", sequence + 1, "");
  CHECK(sequence < 199);
  CHECK(device->read_newest().value() == std::nullopt);
  car.send(1.0, 200);
  const auto next = device->read_newest();
  REQUIRE((next && *next));
  CHECK(decode_report(car_layouts().front(), {}, **next).value().sequence == 200);
}

TEST_CASE("reports that are none are counted and change nothing and a sequence that stands makes the car stale") {
  UserSpaceCar car("U-2");
  CarConnection connection(opener("U-2"), {});
  REQUIRE(becomes_true([&] { return connection.poll(now_s()).is_connected; }));
  car.send(0.5, 1);
  CarReading reading = connection.poll(now_s());
  CHECK(reading.input.accelerator == relative(0.5, 0.001));
  Bytes wrong(controls_report_bytes, std::byte{0xFF});
  wrong[0] = std::byte{controls_report_id};
  for (const std::size_t size : {std::size_t{1}, std::size_t{2}, controls_report_bytes, std::size_t{64}}) {
    wrong.resize(size, std::byte{0xFF});
    car.send(wrong);
    reading = connection.poll(now_s());
    CHECK(reading.input.accelerator == relative(0.5, 0.001));
  }
  wrong[0] = std::byte{99};
  car.send(wrong);
  reading = connection.poll(now_s());
  measured("reports that are none, of 5, that the kernel lets through and we refuse",
           static_cast<double>(connection.refused_reports()), "");
  CHECK(connection.refused_reports() >= 1);  // Some the kernel refuses itself.
  CHECK(connection.take_error().has_value());
  const double since_s = now_s();
  REQUIRE(becomes_true([&] {
    car.send(0.5, 1);
    return connection.poll(now_s()).is_stale;
  }));
  CHECK(now_s() - since_s < 0.11);
  CHECK(connection.poll(now_s()).input.accelerator == 0.0);
  car.send(0.5, 2);
  CHECK_FALSE(connection.poll(now_s()).is_stale);
}

TEST_CASE("a watchdog that is not kept is told and the device used all the same") {
  using Watchdog = UserSpaceCar::Watchdog;
  for (const Watchdog watchdog : {Watchdog::keeps, Watchdog::forgets, Watchdog::refuses}) {
    const int kind = static_cast<int>(watchdog);
    CAPTURE(kind);
    UserSpaceCar car("U-3");
    car.watchdog = watchdog;
    opened("U-3");
    ActuatorWriter writer(opener("U-3"), {});
    std::optional<Error> fault;
    REQUIRE(becomes_true([&] {
      writer.set({.fan = 0.5});
      if (!fault) fault = writer.take_error();
      return car.fan() > 0.49 && (fault || watchdog == Watchdog::keeps);
    }));
    CHECK(fault.has_value() == (watchdog != Watchdog::keeps));
    if (fault) CHECK(fault->what.starts_with("its watchdog does not hold 250 ms"));
  }
}

TEST_CASE("the kernel makes a joystick of the car's descriptor") {
  UserSpaceCar car("U-4");
  std::unique_ptr<InputDevice> joystick;
  REQUIRE(becomes_true([&] {
    auto tried = open_input_device({0x1209, 0x0001, "U-4"});
    if (tried) joystick = std::move(*tried);
    return joystick != nullptr;
  }));
  DriverInput input;
  input.steering_wheel_rad = default_steering_lock_rad;
  input.brake = 1.0;
  input.horn = true;
  car.send(encode_controls(input));
  const auto state = joystick->read();
  REQUIRE(state.has_value());
  const InputState& now = **state;
  REQUIRE((now.axes.contains(ABS_WHEEL) && now.axes.contains(ABS_GAS) && now.axes.contains(ABS_BRAKE)));
  CHECK(now.axes.at(ABS_WHEEL).value == now.axes.at(ABS_WHEEL).low);
  CHECK(now.axes.at(ABS_BRAKE).value == now.axes.at(ABS_BRAKE).high);
  CHECK(now.axes.at(ABS_GAS).value == 0);
  CHECK(now.down.size() >= 1);
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
