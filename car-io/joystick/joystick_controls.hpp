#pragma once
/// An input device as a car: the rig's [car.joystick] says what is what, and whoever reads a HID device reads it.
///
/// Held while held: indicators, horn, high beam, the gears of a lever. Switched by each press: hazard lights, low beam, parking brake, reverse.
/// Events come only when something moves, so that the reports' sequence moves with every reading: such a car is never stale, and unplugging
/// it shows as an error. Of the output reports it takes the hand wheel's force.

#include <set>
#include <string>
#include <vector>

#include "car-io/car_report.hpp"
#include "car-io/hid_device.hpp"
#include "car-io/joystick/input_device.hpp"
#include "engine/rig/rig.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::car_io {

/// 0 to 1 of an axis, for the wheel −1 to 1, within its ends and beyond its dead zone.
double axis_share(const rig::JoystickControl& control, double value);

/// What is remembered from reading to reading.
struct JoystickDriver {
  DriverInput input;
  std::set<std::string, std::less<>> were_down;
};
DriverInput advance(JoystickDriver& driver, const std::vector<rig::JoystickControl>& controls, const InputState& state,
                    double steering_lock_rad);

/// Its emergency stop and re-arm buttons, where [car.joystick] names some.
CarSwitches switches_of(const std::vector<rig::JoystickControl>& controls, const InputState& state);

using OpenInputDevice = std::function<Expected<std::unique_ptr<InputDevice>>()>;
OpenHidDevice joystick_opener(OpenInputDevice open, std::vector<rig::JoystickControl> controls,
                              double steering_lock_rad, const WheelFeel& feel = {});

/// What opens the car that the rig names: its joystick, or else its HID device.
OpenHidDevice car_opener(const rig::Car& car);

}  // namespace septet::car_io
