#include <linux/input.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "car-io/car_connection.hpp"
#include "car-io/joystick/joystick_controls.hpp"
#include "car-io/joystick/joystick_lesson.hpp"
#include "engine/rig/rig.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::car_io {
namespace {

/// A wheel on a table: axis 0 from 0 to 65535 counts to the right; pedals 2 and 5 rest at 255.
struct Wheel {
  InputState state{{{0, {32768, 0, 65535}}, {2, {255, 0, 255}}, {5, {255, 0, 255}}}, {}};
  bool is_there = true, has_motor = true;
  double force = 0.0;
  std::vector<WheelFeel> feels;

  OpenInputDevice opener() {
    return [this]() -> Expected<std::unique_ptr<InputDevice>> {
      if (!is_there) return failure("no such wheel or joystick is plugged in", "input device", "plug it in");
      return std::make_unique<Open>(*this);
    };
  }

 private:
  struct Open final : InputDevice {
    explicit Open(Wheel& of) : wheel(of) {}
    Expected<const InputState*> read() override {
      if (!wheel.is_there) return failure("reading failed: No such device", "input device", "plug it in");
      return &wheel.state;
    }
    Expected<bool> set_force(double share) override {
      wheel.force = share;
      return wheel.has_motor;
    }
    Expected<bool> set_feel(const WheelFeel& feel) override {
      wheel.feels.push_back(feel);
      return true;
    }
    Wheel& wheel;
  };
};

/// Acts as a person asked for each control in turn.
std::vector<rig::JoystickControl> learn(Wheel& wheel) {
  std::vector<rig::JoystickControl> controls;
  const auto ask = [&](const std::string& name, auto act) {
    JoystickLesson lesson;
    wheel.state.axes[0].value = 32700;
    lesson.show_rest(wheel.state);
    wheel.state.axes[0].value = 32800;
    lesson.show_rest(wheel.state);
    const InputState rest = wheel.state;
    act(wheel.state);
    lesson.show(wheel.state);
    wheel.state = rest;
    lesson.show(wheel.state);
    if (const auto control = lesson.learnt(name)) controls.push_back(*control);
  };
  ask("steering", [](InputState& state) { state.axes[0].value = 100; });
  ask("accelerator", [](InputState& state) { state.axes[2].value = 3; });
  ask("brake", [](InputState& state) { state.axes[5].value = 0, state.axes[0].value = 30000; });
  ask("clutch", [](InputState&) {});
  ask("horn", [](InputState& state) { state.down.insert(288); });
  ask("reverse", [](InputState& state) { state.down.insert(293); });
  return controls;
}

}  // namespace

TEST_CASE("a joystick is learnt and what is learnt is a rig's table that drives it") {
  Wheel wheel;
  const auto controls = learn(wheel);
  CHECK(controls.size() == 5);  // Without the clutch, which it has not.
  const std::string rig_text =
      "name = \"r\"\neye_point_m = [1, 0, 1]\n[car]\nsource = \"joystick\"\n" + joystick_toml(controls) +
      "[[screen]]\nname = \"a\"\nlower_left_m = [2, 1, 0]\nlower_right_m = [2, -1, 0]\nupper_left_m = [2, 1, 1]\n";
  const auto rig = rig::read_rig(rig_text, "learnt.toml");
  REQUIRE_MESSAGE(rig.has_value(), why_not(rig));
  REQUIRE(rig->car.joystick.size() == 5);
  CarConnection car(joystick_opener(wheel.opener(), rig->car.joystick, 7.85),
                    {.calibration = {.steering_lock_rad = 7.85}});
  wheel.state.axes[0].value = 100;
  wheel.state.axes[2].value = 128;
  wheel.state.down = {288, 293};
  CarReading reading = car.poll(0.0);
  CHECK_FALSE(reading.is_stale);
  CHECK(reading.input.steering_wheel_rad == relative(7.85, 0.001));
  CHECK(reading.input.accelerator == relative(0.5, 0.02));
  CHECK((reading.input.brake == 0.0 && reading.input.horn && reading.input.selector == GearSelector::reverse));
  wheel.state.axes[0].value = 65535;
  wheel.state.down = {};
  CHECK(car.poll(0.01).input.steering_wheel_rad < -7.8);
  wheel.state.down = {293};
  CHECK(car.poll(0.02).input.selector == GearSelector::drive);
  wheel.state.axes[0].value = 32760;
  CHECK(car.poll(0.03).input.steering_wheel_rad == 0.0);
  CHECK_FALSE(car.poll(60.0).is_stale);  // Nothing moves, and it is present.
}

TEST_CASE("a joystick that is pulled out is lost and found again") {
  Wheel wheel;
  CarConnection car(joystick_opener(wheel.opener(), learn(wheel), 7.85), {});
  CHECK(car.poll(0.0).is_connected);
  wheel.is_there = false;
  CHECK(car.poll(0.01).is_stale);
  wheel.is_there = true;
  CHECK(car.poll(1.0).is_connected);
}

TEST_CASE("the force of the hand wheel reaches its motor and fan and shaker are passed over") {
  Wheel wheel;
  const WheelFeel feel{.spring = 0.3, .damper = 0.2, .friction = 0.1};
  const auto device = joystick_opener(wheel.opener(), {}, 7.85, feel)();
  REQUIRE(device.has_value());
  CHECK((*device)->write(encode_steering(0.5, 1)).has_value());
  CHECK(wheel.force == relative(0.5, 1e-4));
  CHECK(wheel.feels == std::vector{feel});
  CHECK((*device)->write(encode_actuators({.fan = 1.0}, 1)).has_value());
  CHECK(wheel.feels.size() == 1);
  CHECK(wheel.force == relative(0.5, 1e-4));
  wheel.has_motor = false;
  CHECK((*device)->write(encode_steering(0.0, 2)).has_value());
  const auto refused = (*device)->write(encode_steering(0.5, 3));
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().what.starts_with("it has no motor that may be reached"));
}

TEST_CASE("a wheel's effects have their sizes, work to both sides, and end by themselves after 250 ms") {
  const ff_effect damper = condition_effect(FF_DAMPER, 0.5, 3);
  CHECK(damper.type == FF_DAMPER);
  CHECK(damper.id == 3);
  CHECK(damper.replay.length == 250);
  CHECK(damper.u.condition[0].left_coeff == 16384);
  CHECK(damper.u.condition[0].right_coeff == 16384);
  CHECK(damper.u.condition[0].left_saturation == 0xffff);
  for (const double nonsense : {std::nan(""), -3.0})
    CHECK(condition_effect(FF_SPRING, nonsense, -1).u.condition[0].left_coeff == 0);
  CHECK(condition_effect(FF_FRICTION, 7.0, -1).u.condition[0].left_coeff == 32767);
  CHECK(constant_effect(-0.5, 1).u.constant.level == -16384);
  CHECK(constant_effect(1e9, 1).u.constant.level == 32767);
  CHECK(constant_effect(0.5, 1).direction == 0x4000);
}

TEST_CASE("a gear lever makes the gearbox one to be shifted and neutral is between its gears") {
  JoystickDriver driver;
  const std::vector<rig::JoystickControl> lever{{.name = "gear_1", .code = 300}, {.name = "gear_reverse", .code = 306}};
  InputState state;
  CHECK(advance(driver, lever, state, 7.85).selector == GearSelector::manual);
  state.down = {300};
  CHECK(advance(driver, lever, state, 7.85).gear == 1);
  state.down = {};
  CHECK(advance(driver, lever, state, 7.85).gear == 0);
  state.down = {306};
  CHECK(advance(driver, lever, state, 7.85).gear == -1);
}

TEST_CASE("no value of an axis takes a control beyond its ends") {
  for (const double value : {-2147483648.0, -1.0, 0.0, 0.5, 1.0, 2147483647.0, std::nan("")})
    for (const char* name : {"steering", "brake"}) {
      const double share =
          axis_share({.name = name, .is_axis = true, .at_zero = 0.0, .at_one = -1.0, .dead_zone = 0.5}, value);
      CHECK((share <= 1.0 && share >= (std::string(name) == "steering" ? -1.0 : 0.0)));
    }
}

}  // namespace septet::car_io
