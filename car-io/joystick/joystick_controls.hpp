#pragma once
/// An input device as a car: the rig's [car.joystick] assigns its controls, and any reader of a HID device reads it.
///
/// Momentary: indicators, horn, high beam, the gears of a lever. Toggled by each press: hazard lights, low beam,
/// parking brake, reverse. Events come only with motion, so the reports' sequence advances with every reading: such a
/// car is never stale, and unplugging it is an error. Of the output reports it uses the hand wheel's force.

#include <set>
#include <string>
#include <vector>

#include "car-io/car_report.hpp"
#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "engine/rig/rig.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// Axis value 0 to 1, for the wheel −1 to 1, within its ends and beyond its dead zone.
double axis_share(const rig::JoystickControl& control, double value);

/// State between readings.
struct JoystickDriver {
  DriverInput input;
  std::set<std::string, std::less<>> were_down;
};
DriverInput advance(JoystickDriver& driver, const std::vector<rig::JoystickControl>& controls, const InputState& state,
                    double steering_lock_rad);

/// Its emergency stop and re-arm buttons, if [car.joystick] names any.
CarSwitches switches_of(const std::vector<rig::JoystickControl>& controls, const InputState& state);

using OpenInputDevice = std::function<Expected<std::unique_ptr<InputDevice>>()>;
OpenHidDevice joystick_opener(OpenInputDevice open, std::vector<rig::JoystickControl> controls,
                              double steering_lock_rad, const WheelFeel& feel = {});

/// Opener of the rig's car: its joystick, or else its HID device.
OpenHidDevice car_opener(const rig::Car& car);

}  // namespace septet::car_io
