// A wheel with a motor that is all ours (uinput), as evdev shows it.

#include <fcntl.h>
#include <linux/input.h>
#include <linux/uinput.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/actuator_writer.hpp"
#include "car-io/car_connection.hpp"
#include "car-io/joystick/input_device.hpp"
#include "car-io/joystick/joystick_controls.hpp"
#include "tests/relative.hpp"
#include "tests/rig-vm/guest.hpp"

namespace septet::rig_vm {
namespace {

using namespace car_io;

/// Wheel, accelerator, brake, one button, and a motor that plays constant forces.
class MotorWheel {
 public:
  MotorWheel() : file_(open("/dev/uinput", O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
    REQUIRE(file_ >= 0);
    for (const auto& [request, bit] : std::vector<std::pair<unsigned long, int>>{{UI_SET_EVBIT, EV_KEY},
                                                                                 {UI_SET_EVBIT, EV_ABS},
                                                                                 {UI_SET_EVBIT, EV_FF},
                                                                                 {UI_SET_KEYBIT, BTN_TRIGGER},
                                                                                 {UI_SET_FFBIT, FF_CONSTANT}})
      REQUIRE(ioctl(file_, request, bit) == 0);
    for (const auto& [axis, low, high] : {std::tuple{ABS_X, -32767, 32767}, {ABS_GAS, 0, 255}, {ABS_BRAKE, 0, 255}}) {
      uinput_abs_setup setup{};
      setup.code = static_cast<std::uint16_t>(axis);
      setup.absinfo.minimum = low;
      setup.absinfo.maximum = high;
      REQUIRE(ioctl(file_, UI_ABS_SETUP, &setup) == 0);
    }
    uinput_setup setup{};
    setup.id = {BUS_USB, 0x1234, 0x5678, 1};
    setup.ff_effects_max = 4;
    std::strcpy(setup.name, "Motor wheel");
    REQUIRE(ioctl(file_, UI_DEV_SETUP, &setup) == 0);
    REQUIRE(ioctl(file_, UI_DEV_CREATE) == 0);
    thread_ = std::thread([this] { serve(); });
  }
  ~MotorWheel() {
    is_ending_ = true;
    thread_.join();
    close(file_);
  }
  MotorWheel(const MotorWheel&) = delete;
  MotorWheel& operator=(const MotorWheel&) = delete;

  void move(std::uint16_t type, int code, int value) {
    for (const auto& [kind, number, what] : {std::tuple{int{type}, code, value}, {EV_SYN, SYN_REPORT, 0}}) {
      input_event event{};
      event.type = static_cast<std::uint16_t>(kind);
      event.code = static_cast<std::uint16_t>(number);
      event.value = what;
      REQUIRE(write(file_, &event, sizeof event) == static_cast<ssize_t>(sizeof event));
    }
  }
  /// The motor's present force: the levels of playing effects that have not run out, to the left.
  double force() {
    const std::lock_guard lock(mutex_);
    double sum = 0.0;
    for (const auto& [id, effect] : effects_) {
      const bool is_playing =
          playing_since_s_.contains(id) && now_s() - playing_since_s_[id] < effect.replay.length / 1000.0;
      if (is_playing) sum += (effect.direction == 0x4000 ? 1.0 : -1.0) * effect.u.constant.level / 32767.0;
    }
    return sum;
  }
  std::size_t effects() {
    const std::lock_guard lock(mutex_);
    return effects_.size();
  }

 private:
  void serve() {
    while (!is_ending_) {
      pollfd waiting{file_, POLLIN, 0};
      if (poll(&waiting, 1, 20) <= 0) continue;
      input_event event{};
      if (read(file_, &event, sizeof event) != static_cast<ssize_t>(sizeof event)) continue;
      const std::lock_guard lock(mutex_);
      if (event.type == EV_UINPUT && event.code == UI_FF_UPLOAD) {
        uinput_ff_upload upload{};
        upload.request_id = static_cast<std::uint32_t>(event.value);
        REQUIRE(ioctl(file_, UI_BEGIN_FF_UPLOAD, &upload) == 0);
        effects_[upload.effect.id] = upload.effect;
        REQUIRE(ioctl(file_, UI_END_FF_UPLOAD, &upload) == 0);
      } else if (event.type == EV_UINPUT && event.code == UI_FF_ERASE) {
        uinput_ff_erase erase{};
        erase.request_id = static_cast<std::uint32_t>(event.value);
        REQUIRE(ioctl(file_, UI_BEGIN_FF_ERASE, &erase) == 0);
        effects_.erase(static_cast<int>(erase.effect_id));
        REQUIRE(ioctl(file_, UI_END_FF_ERASE, &erase) == 0);
      } else if (event.type == EV_FF) {
        if (event.value > 0)
          playing_since_s_[event.code] = now_s();
        else
          playing_since_s_.erase(event.code);
      }
    }
  }

  int file_;
  std::atomic<bool> is_ending_ = false;
  std::mutex mutex_;  ///< Guards the members below.
  std::map<int, ff_effect> effects_;
  std::map<int, double> playing_since_s_;
  std::thread thread_;
};

Expected<std::unique_ptr<InputDevice>> open_wheel() { return open_input_device({0x1234, 0x5678, ""}); }

const std::vector<rig::JoystickControl> controls = {
    {.name = "steering", .is_axis = true, .code = ABS_X, .at_zero = 0.0, .at_one = -32767.0},
    {.name = "accelerator", .is_axis = true, .code = ABS_GAS, .at_zero = 0.0, .at_one = 255.0},
    {.name = "brake", .is_axis = true, .code = ABS_BRAKE, .at_zero = 0.0, .at_one = 255.0},
    {.name = "horn", .code = BTN_TRIGGER}};

}  // namespace

TEST_SUITE_BEGIN("joystick");

TEST_CASE("a wheel drives and is released when it is pulled out and drives again when it is back") {
  auto wheel = std::make_unique<MotorWheel>();
  CarConnection car(joystick_opener(open_wheel, controls, 7.85), {.calibration = {.steering_lock_rad = 7.85}});
  REQUIRE(becomes_true([&] { return car.poll(now_s()).is_connected; }));
  for (int time = 0; time < 2; ++time) {
    wheel->move(EV_ABS, ABS_X, 16384);
    wheel->move(EV_ABS, ABS_GAS, 51);
    wheel->move(EV_KEY, BTN_TRIGGER, 1);
    CarReading reading = car.poll(now_s());
    CHECK(reading.input.steering_wheel_rad == relative(-3.925, 0.001));
    CHECK(reading.input.accelerator == relative(0.2, 0.001));
    CHECK(reading.input.horn);
    wheel.reset();
    reading = car.poll(now_s());
    CHECK((!reading.is_connected && reading.input.accelerator == 0.0 && !reading.input.horn));
    wheel = std::make_unique<MotorWheel>();
    const double back_s = now_s();
    REQUIRE(becomes_true([&] { return car.poll(now_s()).is_connected; }));
    measured("joystick plugged in to driving again", 1000.0 * (now_s() - back_s), "ms");
    CHECK(now_s() - back_s < 1.0);
  }
}

TEST_CASE("events that the kernel throws away are not missed") {
  MotorWheel wheel;
  std::unique_ptr<InputDevice> device;
  REQUIRE(becomes_true([&] {
    auto opened = open_wheel();
    if (opened) device = std::move(*opened);
    return device != nullptr;
  }));
  for (int i = 0; i <= 4000; ++i) wheel.move(EV_ABS, i % 2 == 0 ? ABS_X : ABS_GAS, i % 2 == 0 ? i : i % 256);
  wheel.move(EV_KEY, BTN_TRIGGER, 1);
  for (int i = 0; i < 100; ++i) REQUIRE(device->read().has_value());
  const InputState& state = *device->read().value();
  CHECK(state.axes.at(ABS_X).value == 4000);
  CHECK(state.axes.at(ABS_GAS).value == 3999 % 256);
  CHECK(state.down.contains(BTN_TRIGGER));
}

TEST_CASE("the motor plays one effect that is changed and ends with silence or with the program") {
  MotorWheel wheel;
  const OpenHidDevice open = joystick_opener(open_wheel, controls, 7.85);
  REQUIRE(becomes_true([&] { return open().has_value(); }));
  {
    ActuatorWriter writer(open, {.has_steering_force = true, .sticky = true});
    for (const double force : {0.25, -0.5, 1.0}) {
      CAPTURE(force);
      CHECK(becomes_true([&] {
        writer.set({.steering = force});
        return wheel.force() == relative(force, 0.001);
      }));
    }
    CHECK(wheel.effects() == 1);
    const double since_s = now_s();
    REQUIRE(becomes_true([&] { return wheel.force() == 0.0; }));
    measured("silent simulation to no wheel force, evdev", 1000.0 * (now_s() - since_s), "ms");
    CHECK(now_s() - since_s < 0.42);
  }
  CHECK(becomes_true([&] { return wheel.effects() == 0; }));
  // A hung program: nothing more is written, and the file stays open.
  const auto hung = open_wheel();
  REQUIRE(hung.has_value());
  REQUIRE((*hung)->set_force(0.5).value());
  CHECK(becomes_true([&] { return wheel.force() > 0.49; }));
  const double since_s = now_s();
  CHECK(becomes_true([&] { return wheel.force() == 0.0; }));
  measured("hung program to no wheel force, evdev", 1000.0 * (now_s() - since_s), "ms");
  CHECK(now_s() - since_s < 0.26);
}

TEST_SUITE_END();

}  // namespace septet::rig_vm
