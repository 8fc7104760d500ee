#include "car-io/joystick/joystick_controls.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <fmt/core.h>

#include "car-io/car_report.hpp"
#include "car-io/usb_device.hpp"

namespace septet::car_io {
namespace {

class JoystickDevice final : public HidDevice {
 public:
  JoystickDevice(std::unique_ptr<InputDevice> device, std::vector<rig::JoystickControl> controls,
                 double steering_lock_rad, const WheelFeel& feel)
      : device_(std::move(device)),
        controls_(std::move(controls)),
        steering_lock_rad_(steering_lock_rad),
        feel_(feel) {}

  Expected<std::optional<Bytes>> read_newest() override {
    const auto state = device_->read();
    if (!state) return tl::unexpected(state.error());
    DriverInput input = advance(driver_, controls_, **state, steering_lock_rad_);
    input.sequence = ++sequence_;
    const auto report = encode_controls(input, steering_lock_rad_, switches_of(controls_, **state));
    return Bytes(report.begin(), report.end());
  }
  Expected<void> write(std::span<const std::byte> report) override {
    const auto force = decode_steering(report);
    if (!force) return {};  // A report for fan and shaker, which a joystick lacks.
    // Once: it goes on by itself for as long as a force is set.
    if (!std::exchange(has_feel_, true))
      if (auto felt = device_->set_feel(feel_); !felt) return tl::unexpected(felt.error());
    auto set = device_->set_force(*force);
    if (!set) return tl::unexpected(std::move(set.error()));
    if (!*set && *force != 0.0)
      return failure("it has no motor that may be reached (constant force, by its driver or by HID PID)",
                     "the joystick",
                     "septet devices says what may not be opened; else set [car.actuators] steering_most = 0");
    return {};
  }
  /// A force ends by itself after the time that is set there.
  Expected<Bytes> get_feature(std::uint8_t, std::size_t) override { return feature_; }
  Expected<void> send_feature(std::span<const std::byte> report) override {
    feature_.assign(report.begin(), report.end());
    return {};
  }

 private:
  std::unique_ptr<InputDevice> device_;
  std::vector<rig::JoystickControl> controls_;
  double steering_lock_rad_;
  WheelFeel feel_;
  JoystickDriver driver_;
  std::uint8_t sequence_ = 0;
  Bytes feature_;
  bool has_feel_ = false;
};

}  // namespace

double axis_share(const rig::JoystickControl& control, double value) {
  const double share = (value - control.at_zero) / (control.at_one - control.at_zero);
  if (!std::isfinite(share)) return 0.0;
  const double beyond = (std::abs(share) - control.dead_zone) / (1.0 - control.dead_zone);
  const double size = std::clamp(beyond, 0.0, 1.0);
  return control.name == "steering" ? std::copysign(size, share) : share > 0.0 ? size : 0.0;
}

DriverInput advance(JoystickDriver& driver, const std::vector<rig::JoystickControl>& controls, const InputState& state,
                    double steering_lock_rad) {
  DriverInput& input = driver.input;
  const auto value_of = [&](std::string_view name) -> std::optional<double> {
    const auto control = std::ranges::find(controls, name, &rig::JoystickControl::name);
    if (control == controls.end()) return std::nullopt;
    if (!control->is_axis) return state.down.contains(control->code) ? 1.0 : 0.0;
    const auto axis = state.axes.find(control->code);
    return axis == state.axes.end() ? 0.0 : axis_share(*control, axis->second.value);
  };
  const auto is_down = [&](std::string_view name) { return value_of(name).value_or(0.0) > 0.5; };
  const auto is_pressed = [&](std::string_view name) {
    const bool now = is_down(name), before = driver.were_down.contains(name);
    if (now && !before) driver.were_down.emplace(name);
    if (!now && before) driver.were_down.erase(driver.were_down.find(name));
    return now && !before;
  };
  input.steering_wheel_rad = value_of("steering").value_or(0.0) * steering_lock_rad;
  input.accelerator = value_of("accelerator").value_or(0.0);
  input.brake = value_of("brake").value_or(0.0);
  input.clutch = value_of("clutch").value_or(0.0);
  const bool left = is_down("indicator_left"), right = is_down("indicator_right");
  input.indicator = left == right ? IndicatorStalk::off : left ? IndicatorStalk::left : IndicatorStalk::right;
  input.horn = is_down("horn");
  input.high_beam = is_down("high_beam");
  input.hazard_lights ^= is_pressed("hazard_lights");
  input.low_beam ^= is_pressed("low_beam");
  input.parking_brake ^= is_pressed("parking_brake");
  if (is_pressed("reverse"))
    input.selector = input.selector == GearSelector::reverse ? GearSelector::drive : GearSelector::reverse;
  bool has_lever = false;
  std::int8_t gear = 0;
  for (int i = 0; i <= 6; ++i) {
    const auto held = value_of(i == 0 ? "gear_reverse" : fmt::format("gear_{}", i));
    has_lever |= i > 0 && held.has_value();
    if (held.value_or(0.0) > 0.5) gear = static_cast<std::int8_t>(i == 0 ? -1 : i);
  }
  if (has_lever) {
    input.selector = GearSelector::manual;
    input.gear = gear;
  }
  return input;
}

CarSwitches switches_of(const std::vector<rig::JoystickControl>& controls, const InputState& state) {
  const auto is_on = [&](std::string_view name) {
    const auto control = std::ranges::find(controls, name, &rig::JoystickControl::name);
    if (control == controls.end()) return false;
    if (!control->is_axis) return state.down.contains(control->code);
    const auto axis = state.axes.find(control->code);
    return axis != state.axes.end() && axis_share(*control, axis->second.value) > 0.5;
  };
  return {is_on("emergency_stop"), is_on("rearm")};
}

OpenHidDevice joystick_opener(OpenInputDevice open, std::vector<rig::JoystickControl> controls,
                              double steering_lock_rad, const WheelFeel& feel) {
  return [open = std::move(open), controls = std::move(controls), steering_lock_rad,
          feel]() -> Expected<std::unique_ptr<HidDevice>> {
    auto device = open();
    if (!device) return tl::unexpected(device.error());
    return std::make_unique<JoystickDevice>(std::move(*device), controls, steering_lock_rad, feel);
  };
}

OpenHidDevice car_opener(const rig::Car& car) {
  if (car.source == rig::CarSource::joystick)
    return joystick_opener(
        [address = InputAddress{car.vendor_id, car.product_id, car.serial}] { return open_input_device(address); },
        car.joystick, car.calibration.steering_lock_rad,
        {car.actuators.wheel_spring, car.actuators.wheel_damper, car.actuators.wheel_friction});
  return hid_opener(car);
}

}  // namespace septet::car_io
