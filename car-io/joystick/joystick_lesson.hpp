#pragma once
/// What moves when a person is asked to move one control: how `septet-car learn` finds out what a joystick's axes and buttons are.
///
/// A lesson begins with the device at rest. Of the axes the one that went furthest from rest, by its own range, is the control; where none
/// went a quarter of it, the first button that went down is. A pure function of what it is shown.

#include <optional>
#include <string>
#include <vector>

#include "car-io/joystick/input_device.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

class JoystickLesson {
 public:
  /// `rest`: hands off. As often as wanted: trembling widens the dead zone.
  void show_rest(const InputState& rest);
  void show(const InputState& state);
  /// What the control `name` is; nothing where nothing moved.
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
