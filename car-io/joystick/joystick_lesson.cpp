#include "car-io/joystick/joystick_lesson.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

namespace septet::car_io {
namespace {

constexpr double least_travel = 0.25;  // Share of an axis' range.
constexpr double least_dead_zone = 0.005, most_dead_zone = 0.2;

}  // namespace

void JoystickLesson::show_rest(const InputState& rest) {
  for (const auto& [code, axis] : rest.axes) {
    const double value = axis.value;
    const auto [place, is_new] = axes_.try_emplace(code, Axis{value, value, value, value, 0.0});
    Axis& known = place->second;
    known.rest_low = known.low = std::min(known.rest_low, value);
    known.rest_high = known.high = std::max(known.rest_high, value);
    known.range = static_cast<double>(axis.high) - static_cast<double>(axis.low);
  }
  down_at_rest_.insert(rest.down.begin(), rest.down.end());
}

void JoystickLesson::show(const InputState& state) {
  for (const auto& [code, axis] : state.axes)
    if (const auto known = axes_.find(code); known != axes_.end()) {
      known->second.low = std::min<double>(known->second.low, axis.value);
      known->second.high = std::max<double>(known->second.high, axis.value);
    }
  for (const std::uint16_t button : state.down)
    if (!pressed_ && !down_at_rest_.contains(button)) pressed_ = button;
}

std::optional<rig::JoystickControl> JoystickLesson::learnt(const std::string& name) const {
  std::optional<rig::JoystickControl> best;
  double furthest = least_travel;
  for (const auto& [code, axis] : axes_) {
    if (!(axis.range > 0.0)) continue;
    const double rest = (axis.rest_low + axis.rest_high) / 2.0;
    const double up = axis.high - rest, down = rest - axis.low, travel = std::max(up, down);
    if (travel / axis.range < furthest) continue;
    furthest = travel / axis.range;
    const double trembling = (axis.rest_high - axis.rest_low) / travel;
    best = rig::JoystickControl{.name = name,
                                .is_axis = true,
                                .code = code,
                                .at_zero = rest,
                                .at_one = up > down ? axis.high : axis.low,
                                .dead_zone = std::clamp(trembling, least_dead_zone, most_dead_zone)};
  }
  if (!best && pressed_) best = rig::JoystickControl{.name = name, .code = *pressed_};
  return best;
}

std::string joystick_toml(const std::vector<rig::JoystickControl>& controls) {
  std::string text = "[car.joystick]\n";
  for (const auto& control : controls)
    text += control.is_axis
                ? fmt::format("{} = {{ axis = {}, at_zero = {:.1f}, at_one = {:.1f}, dead_zone = {:.3f} }}\n",
                              control.name, control.code, control.at_zero, control.at_one, control.dead_zone)
                : fmt::format("{} = {{ button = {} }}\n", control.name, control.code);
  return text;
}

}  // namespace septet::car_io
