// An artificial wheel of HID PID (uhid): the kernel makes a joystick of it, without force feedback.

#include <linux/input.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/devices/device_list.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/joystick/joystick_controls.hpp"
#include "tests/car-io/pid/simulated_pid_wheel.hpp"
#include "tests/relative.hpp"
#include "tests/rig-vm/guest.hpp"
#include "tests/rig-vm/uhid_device.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

class PidWheelOnUhid {
 public:
  PidWheelOnUhid()
      : device_({"PID wheel", "", pid_wheel_descriptor, 0x1234, 0x0f0f},
                {[this](std::span<const std::byte> report) { take(report); },
                 [this](std::span<const std::byte> report) {
                   take(report);
                   return 0;
                 },
                 [this] { return block_load(); }}) {}

  void turn_to(std::int16_t x) {
    const std::uint8_t report[] = {1, static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(x >> 8), 0, 0, 0};
    device_.send(std::as_bytes(std::span(report)));
  }
  double playing(int type) {
    const std::lock_guard lock(mutex_);
    return wheel_.playing(type, now_s());
  }
  int wrong() {
    const std::lock_guard lock(mutex_);
    return wheel_.wrong();
  }

 private:
  void take(std::span<const std::byte> report) {
    const std::lock_guard lock(mutex_);
    wheel_.take(report, now_s());
  }
  Bytes block_load() {
    const std::lock_guard lock(mutex_);
    return wheel_.block_load();
  }

  std::mutex mutex_;  ///< Of the wheel.
  SimulatedPidWheel wheel_;
  UhidDevice device_;  ///< Last: it answers with the wheel.
};

Expected<std::unique_ptr<InputDevice>> open_pid_wheel() { return open_input_device({0x1234, 0x0f0f, ""}); }

OpenHidDevice pid_wheel_opener() {
  return joystick_opener(open_pid_wheel,
                         {{.name = "steering", .is_axis = true, .code = ABS_X, .at_zero = 0.0, .at_one = -32767.0}},
                         7.85, {.spring = 0.2, .damper = 0.1, .friction = 0.04});
}

constexpr int constant = 1, spring = 3, damper = 4, friction = 6;

}  // namespace

TEST_SUITE_BEGIN("joystick");

TEST_CASE("a wheel whose force the kernel does not know is moved by HID PID through hidraw and rests in time") {
  PidWheelOnUhid wheel;
  CarConnection car(pid_wheel_opener(), {.calibration = {.steering_lock_rad = 7.85}});
  REQUIRE(becomes_true([&] { return car.poll(now_s()).is_connected; }));
  {
    ActuatorWriter writer(pid_wheel_opener(), {.has_steering_force = true, .sticky = true});
    for (const double force : {0.25, -0.5, 1.0}) {
      CAPTURE(force);
      CHECK(becomes_true([&] {
        writer.set({.steering = force});
        return wheel.playing(constant) == relative(force, 0.001);
      }));
    }
    CHECK(wheel.playing(spring) == doctest::Approx(0.2));
    CHECK(wheel.playing(damper) == doctest::Approx(0.1));
    CHECK(wheel.playing(friction) == doctest::Approx(0.04));
    // It is read meanwhile.
    wheel.turn_to(-16384);
    CHECK(becomes_true([&] {
      writer.set({.steering = 0.5});
      return car.poll(now_s()).input.steering_wheel_rad == relative(3.925, 0.001);
    }));
    const double since_s = now_s();
    REQUIRE(becomes_true([&] { return wheel.playing(constant) == 0.0; }));
    measured("silent simulation to no wheel force, HID PID", 1000.0 * (now_s() - since_s), "ms");
    CHECK(now_s() - since_s < 0.42);
    CHECK(writer.is_cut());
  }
  CHECK(wheel.playing(damper) == 0.0);
  // A program that hangs.
  const auto hung = open_pid_wheel();
  REQUIRE(hung.has_value());
  REQUIRE((*hung)->set_force(0.5).value());
  REQUIRE(becomes_true([&] { return wheel.playing(constant) > 0.49; }));
  const double since_s = now_s();
  CHECK(becomes_true([&] { return wheel.playing(constant) == 0.0; }));
  measured("hung program to no wheel force, HID PID", 1000.0 * (now_s() - since_s), "ms");
  CHECK(now_s() - since_s < 0.26);
  CHECK(wheel.wrong() == 0);
}

TEST_CASE("a wheel of HID PID that is pulled out and back is moved again") {
  auto wheel = std::make_unique<PidWheelOnUhid>();
  REQUIRE(becomes_true([] { return open_pid_wheel().has_value(); }));
  ActuatorWriter writer(pid_wheel_opener(), {.has_steering_force = true});
  for (int time = 0; time < 2; ++time) {
    const double since_s = now_s();
    CHECK(becomes_true([&] {
      writer.set({.steering = 0.5});
      return wheel->playing(constant) > 0.49;
    }));
    if (time == 1) measured("wheel of HID PID plugged in to its force", 1000.0 * (now_s() - since_s), "ms");
    wheel.reset();
    if (time == 0) wheel = std::make_unique<PidWheelOnUhid>();
  }
}

TEST_CASE("a wheel whose motor may not be reached drives and whoever wants its force is told") {
  PidWheelOnUhid wheel;
  REQUIRE(becomes_true([] { return open_pid_wheel().has_value(); }));
  // A system without a rule for hidraw, also for root.
  command("mkdir -p /tmp/hidden && for node in /dev/hidraw*; do mv $node /tmp/hidden; done");
  CarConnection car(pid_wheel_opener(), {.calibration = {.steering_lock_rad = 7.85}});
  CHECK(becomes_true([&] { return car.poll(now_s()).is_connected; }));
  ActuatorWriter writer(pid_wheel_opener(), {.has_steering_force = true});
  std::optional<Error> fault;
  CHECK(becomes_true([&] {
    writer.set({.steering = 0.5});
    if (!fault) fault = writer.take_error();
    return fault.has_value();
  }));
  CHECK(fault->what.find("it has no motor that may be reached") != std::string::npos);
  // Its entry in septet devices.
  const auto listed = [] {
    for (const FoundDevice& found : list_devices("/sys", "/dev"))
      if (found.kind == DeviceKind::joystick && found.product_id == 0x0f0f) return found;
    return FoundDevice{};
  };
  CHECK(listed().detail.starts_with("force by HID PID through /dev/hidraw"));
  CHECK(listed().detail.ends_with("MAY NOT BE OPENED"));
  CHECK(listed().remedy.starts_with(R"(SUBSYSTEM=="hidraw", KERNELS=="0003:1234:0F0F.*")"));
  command("mv /tmp/hidden/* /dev");
  CHECK(listed().remedy.empty());
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
