#pragma once
/// Keys and gamepad axes to a DriverInput, for a person who drives without a wheel.
///
/// Keys are on or off, a hand wheel is not: the wheel moves towards its target at a limited rate, slowly at first and
/// no faster than hands turn it, and the target shrinks with speed so that full steering asks for about the same
/// lateral acceleration at any speed. So a tap corrects, and a held key turns. Pedals rise and fall at their own rates.
/// Pure functions over plain state; the caller owns the clock.

#include <cstdint>

#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// Keys held down now.
struct KeyStates {
  bool left = false, right = false;
  bool accelerate = false, brake = false;
  bool parking_brake = false;               ///< While held.
  bool set_parking_brake = false;           ///< Each press sets or releases it.
  bool manual = false;                      ///< Each press at a standstill toggles manual gears.
  bool clutch = false;                      ///< The pedal, while held.
  bool gear_up = false, gear_down = false;  ///< Each press, with gears by hand.
  bool indicator_left = false,
       indicator_right = false;                  ///< Each press switches; the other one or the same switches back.
  bool hazard_lights = false, low_beam = false;  ///< Each press switches.
  bool high_beam = false, horn = false;          ///< While held.
  bool look_left = false, look_right = false;    ///< While held.

  bool operator==(const KeyStates&) const = default;
};

struct KeyboardSettings {
  double lateral_acceleration_mps2 = 5.0;  ///< At full steering, once the lock no longer limits.
  double wheelbase_m = 2.8;
  double steering_ratio = 16.0;     ///< Hand wheel over road wheel.
  double largest_angle_rad = 7.0;   ///< Angle of the hand wheel, at a standstill.
  double steer_time_s = 0.45;       ///< From straight to the target, at the rate of a key held long.
  double return_time_s = 0.25;      ///< From the target to straight.
  double hand_speed_radps = 4.5;    ///< At most, away from straight: the times above apply to small targets.
  double return_speed_radps = 9.0;  ///< At most, back to straight, and from one side to the other.
  /// Travel times of a pedal; for the brake at the rate of a key held long.
  double press_time_s = 0.35, release_time_s = 0.15;
  /// A fresh key turns the wheel, and presses the brake, at this share of the rate; at all of it once held for this
  /// long.
  double first_share = 0.2, steer_growth_s = 0.4, brake_growth_s = 0.8;
  double return_growth_s = 0.3;  ///< The same for a released wheel: a driver who taps through a bend holds it.
  /// The clutch pedal goes down quickly. It comes up slowly through the bite while the accelerator is pressed, and
  /// quickly otherwise.
  double clutch_press_time_s = 0.12, clutch_bite_time_s = 1.6, clutch_drop_time_s = 0.15;
  std::int8_t gears = 6;  ///< A car with fewer uses its highest.
  double look_angle_rad = 0.9;
  double look_rate_radps = 5.0;  ///< A head turns by 50° in less than 0.2 s.
};

/// State between ticks.
struct KeyboardDriver {
  KeyboardSettings settings;
  DriverInput input;
  KeyStates previous;
  double steered_for_s = 0.0, braked_for_s = 0.0;  ///< Time for which the same key has been held.
  double let_go_for_s = 0.0;                       ///< Time without a key.
  bool reverse_armed = false;  ///< The brake key was released at a standstill, so that the next press means reverse.
  bool parking_brake_is_set = false;
};

/// Hand-wheel angle of full steering at this speed.
double largest_steering_rad(const KeyboardSettings& settings, double speed_mps);

/// The input after `dt_s` more of these keys. `speed_mps` is the car's, along its x axis. At a standstill, a new press
/// of the brake key drives backwards, and the accelerator key then brakes, as players of games expect. With manual
/// gears the brake key only brakes, and reverse is a gear below neutral.
DriverInput advance(KeyboardDriver& driver, const KeyStates& keys, double speed_mps, double dt_s);

/// A gamepad in the standard arrangement (GLFW's mapping): sticks −1 to 1, triggers −1 (released) to 1.
struct GamepadState {
  double left_stick_x = 0.0;  ///< Positive to the right.
  double right_stick_x = 0.0;
  double left_trigger = -1.0, right_trigger = -1.0;
  KeyStates buttons;     ///< Except steering, pedals and looks.
  bool reverse = false;  ///< Each press switches between drive and reverse.
};

struct GamepadSettings {
  double dead_zone = 0.12;  ///< Share of the stick's travel.
  double exponent = 1.8;    ///< Finer near the middle.
  KeyboardSettings keys;    ///< Largest angle by speed.
  double steering_rate_radps = 9.0;
};

struct GamepadDriver {
  GamepadSettings settings;
  KeyboardDriver switches;  ///< Lamps and indicators, as from keys.
  bool previous_reverse = false;
};

DriverInput advance(GamepadDriver& driver, const GamepadState& gamepad, double speed_mps, double dt_s);

}  // namespace septet::car_io
