#include "car-io/keyboard_driver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace septet::car_io {
namespace {

constexpr double standstill_mps = 0.5;

double approach(double value, double target, double step) { return value + std::clamp(target - value, -step, step); }

double move_pedal(double pedal, bool pressed, const KeyboardSettings& settings, double dt_s) {
  return approach(pedal, pressed ? 1.0 : 0.0, dt_s / (pressed ? settings.press_time_s : settings.release_time_s));
}

/// The share of its rate that a key has in the middle of the next `dt_s`, and `held_for_s` after them.
double grown(double& held_for_s, double growth_s, double first_share, double dt_s) {
  const double share = std::clamp((held_for_s + dt_s / 2) / growth_s, first_share, 1.0);
  held_for_s += dt_s;
  return share;
}

double move_brake(KeyboardDriver& driver, bool pressed, double dt_s) {
  const KeyboardSettings& settings = driver.settings;
  if (!pressed) driver.braked_for_s = 0.0;
  const double share = pressed ? grown(driver.braked_for_s, settings.brake_growth_s, settings.first_share, dt_s) : 1.0;
  return move_pedal(driver.input.brake, pressed, settings, share * dt_s);
}

/// `side`: 1 to the left, -1 to the right, 0 neither.
double turn_wheel(KeyboardDriver& driver, double side, double largest_rad, double dt_s) {
  const KeyboardSettings& settings = driver.settings;
  const double now_rad = driver.input.steering_wheel_rad, target_rad = largest_rad * side;
  if (side != 0.0) driver.let_go_for_s = 0.0;
  if (target_rad == 0.0 || target_rad * now_rad < 0.0) {
    driver.steered_for_s = 0.0;
    const double share =
        side == 0.0 ? grown(driver.let_go_for_s, settings.return_growth_s, settings.first_share, dt_s) : 1.0;
    return approach(now_rad, target_rad,
                    share * std::min(largest_rad / settings.return_time_s, settings.return_speed_radps) * dt_s);
  }
  const double share = grown(driver.steered_for_s, settings.steer_growth_s, settings.first_share, dt_s);
  return approach(now_rad, target_rad,
                  share * std::min(largest_rad / settings.steer_time_s, settings.hand_speed_radps) * dt_s);
}

bool is_new(bool now, bool before) { return now && !before; }

/// Indicators, lamps and the other switches.
void move_switches(KeyboardDriver& driver, const KeyStates& keys) {
  DriverInput& input = driver.input;
  const auto flip_to = [&](IndicatorStalk side) {
    input.indicator = input.indicator == side ? IndicatorStalk::off : side;
  };
  if (is_new(keys.indicator_left, driver.previous.indicator_left)) flip_to(IndicatorStalk::left);
  if (is_new(keys.indicator_right, driver.previous.indicator_right)) flip_to(IndicatorStalk::right);
  if (is_new(keys.hazard_lights, driver.previous.hazard_lights)) input.hazard_lights = !input.hazard_lights;
  if (is_new(keys.low_beam, driver.previous.low_beam)) input.low_beam = !input.low_beam;
  input.high_beam = keys.high_beam;
  input.horn = keys.horn;
  if (is_new(keys.set_parking_brake, driver.previous.set_parking_brake))
    driver.parking_brake_is_set = !driver.parking_brake_is_set;
  input.parking_brake = keys.parking_brake || driver.parking_brake_is_set;
  driver.previous = keys;
  ++input.sequence;
}

/// The head turns at a limited rate, and the pictures with it.
void look(KeyboardDriver& driver, double target_rad, double dt_s) {
  double& heading_rad = driver.input.gaze_heading_rad;
  heading_rad = approach(heading_rad, target_rad, driver.settings.look_rate_radps * dt_s);
  driver.input.head.turn_rad = heading_rad;
}

/// Gears by hand, from neutral on, or the automatic gearbox.
void choose_gearbox(KeyboardDriver& driver, const KeyStates& keys, double speed_mps) {
  DriverInput& input = driver.input;
  if (!is_new(keys.manual, driver.previous.manual) || std::abs(speed_mps) > standstill_mps) return;
  input.selector = input.selector == GearSelector::manual ? GearSelector::drive : GearSelector::manual;
  input.gear = 0;
  driver.reverse_armed = false;
}

/// The left foot and the lever. The gearbox models the effect of a gear without the clutch.
void move_clutch_and_lever(KeyboardDriver& driver, const KeyStates& keys, double dt_s) {
  const KeyboardSettings& settings = driver.settings;
  DriverInput& input = driver.input;
  const double up_time_s = keys.accelerate ? settings.clutch_bite_time_s : settings.clutch_drop_time_s;
  input.clutch =
      approach(input.clutch, keys.clutch ? 1.0 : 0.0, dt_s / (keys.clutch ? settings.clutch_press_time_s : up_time_s));
  if (input.selector != GearSelector::manual) return;
  const int steps = (is_new(keys.gear_up, driver.previous.gear_up) ? 1 : 0) -
                    (is_new(keys.gear_down, driver.previous.gear_down) ? 1 : 0);
  input.gear = static_cast<std::int8_t>(std::clamp(input.gear + steps, -1, static_cast<int>(settings.gears)));
}

/// Drive or reverse, by the pedal key that is pressed first at a standstill.
void choose_direction(KeyboardDriver& driver, const KeyStates& keys, double speed_mps) {
  GearSelector& selector = driver.input.selector;
  if (selector == GearSelector::manual) return;
  if (std::abs(speed_mps) > standstill_mps) {
    driver.reverse_armed = false;
    return;
  }
  if (selector != GearSelector::reverse) {
    if (driver.reverse_armed && is_new(keys.brake, driver.previous.brake)) selector = GearSelector::reverse;
    if (!keys.brake && !keys.accelerate) driver.reverse_armed = true;
  } else if (is_new(keys.accelerate, driver.previous.accelerate)) {
    selector = GearSelector::drive;
    driver.reverse_armed = false;
  }
}

}  // namespace

double largest_steering_rad(const KeyboardSettings& settings, double speed_mps) {
  // Steady turning of a neutral car: tan(road wheel) = wheelbase · a / v².
  const double tangent =
      settings.wheelbase_m * settings.lateral_acceleration_mps2 / std::max(speed_mps * speed_mps, 1e-6);
  return std::min(settings.largest_angle_rad, settings.steering_ratio * std::atan(tangent));
}

DriverInput advance(KeyboardDriver& driver, const KeyStates& keys, double speed_mps, double dt_s) {
  const KeyboardSettings& settings = driver.settings;
  DriverInput& input = driver.input;
  choose_gearbox(driver, keys, speed_mps);
  choose_direction(driver, keys, speed_mps);
  move_clutch_and_lever(driver, keys, dt_s);
  const bool reverse = input.selector == GearSelector::reverse;
  input.accelerator = move_pedal(input.accelerator, reverse ? keys.brake : keys.accelerate, settings, dt_s);
  input.brake = move_brake(driver, reverse ? keys.accelerate : keys.brake, dt_s);
  input.steering_wheel_rad = turn_wheel(driver, (keys.left ? 1.0 : 0.0) - (keys.right ? 1.0 : 0.0),
                                        largest_steering_rad(settings, speed_mps), dt_s);
  look(driver, settings.look_angle_rad * ((keys.look_left ? 1.0 : 0.0) - (keys.look_right ? 1.0 : 0.0)), dt_s);
  move_switches(driver, keys);
  return input;
}

DriverInput advance(GamepadDriver& driver, const GamepadState& gamepad, double speed_mps, double dt_s) {
  const GamepadSettings& settings = driver.settings;
  DriverInput& input = driver.switches.input;
  const auto finite = [](double value, double fallback) {
    return std::isfinite(value) ? std::clamp(value, -1.0, 1.0) : fallback;
  };
  const double stick = finite(gamepad.left_stick_x, 0.0);
  const double beyond = std::max(0.0, std::abs(stick) - settings.dead_zone) / (1.0 - settings.dead_zone);
  const double target =
      -std::copysign(std::pow(beyond, settings.exponent), stick) * largest_steering_rad(settings.keys, speed_mps);
  input.steering_wheel_rad = approach(input.steering_wheel_rad, target, settings.steering_rate_radps * dt_s);
  input.accelerator = (finite(gamepad.right_trigger, -1.0) + 1.0) / 2.0;
  input.brake = (finite(gamepad.left_trigger, -1.0) + 1.0) / 2.0;
  look(driver.switches, -finite(gamepad.right_stick_x, 0.0) * std::numbers::pi / 2.0, dt_s);
  if (is_new(gamepad.reverse, driver.previous_reverse) && std::abs(speed_mps) <= standstill_mps)
    input.selector = input.selector == GearSelector::reverse ? GearSelector::drive : GearSelector::reverse;
  driver.previous_reverse = gamepad.reverse;
  move_switches(driver.switches, gamepad.buttons);
  return input;
}

}  // namespace septet::car_io
