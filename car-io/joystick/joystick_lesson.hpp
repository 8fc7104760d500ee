#pragma once
/// Detection of the control that a person moves on request: how `septet-car learn` identifies a joystick's axes and
/// buttons.
///
/// A lesson begins with the device at rest. The axis that went furthest from rest, relative to its own range, is the
/// control; if none went a quarter of it, the first pressed button is. A pure function of its inputs.

#include <optional>
#include <string>
#include <vector>

#include "car-io/joystick/input_device.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

class JoystickLesson {
 public:
  /// `rest`: hands off. Any number of calls: trembling widens the dead zone.
  void show_rest(const InputState& rest);
  void show(const InputState& state);
  /// The detected control `name`; empty if nothing moved.
  std::optional<rig::JoystickControl> learnt(const std::string& name) const;

 private:
  struct Axis {
    double rest_low = 0.0, rest_high = 0.0, low = 0.0, high = 0.0, range = 0.0;
  };
  std::map<std::uint16_t, Axis> axes_;
  std::set<std::uint16_t> down_at_rest_;
  std::optional<std::uint16_t> pressed_;
};

/// The rig's [car.joystick].
std::string joystick_toml(const std::vector<rig::JoystickControl>& controls);

}  // namespace septet::car_io
