#include "car-io/joystick/wheel_effects.hpp"

#include <linux/input.h>

#include <algorithm>
#include <cmath>

namespace septet::car_io {
namespace {

double number(double value) { return std::isfinite(value) ? value : 0.0; }

}  // namespace

ff_effect constant_effect(double force, std::int16_t id) {
  ff_effect effect{};
  effect.type = FF_CONSTANT;
  effect.id = id;
  effect.direction = 0x4000;  // To the left, the sign of a positive level.
  effect.replay.length = effect_ends_after_ms;
  effect.u.constant.level = static_cast<std::int16_t>(std::lround(32767.0 * std::clamp(number(force), -1.0, 1.0)));
  return effect;
}

ff_effect condition_effect(std::uint16_t type, double share, std::int16_t id) {
  ff_effect effect{};
  effect.type = type;
  effect.id = id;
  effect.direction = 0x4000;
  effect.replay.length = effect_ends_after_ms;
  const double size = std::clamp(number(share), 0.0, 1.0);
  ff_condition_effect& condition = effect.u.condition[0];
  condition.left_coeff = condition.right_coeff = static_cast<std::int16_t>(std::lround(32767.0 * size));
  condition.left_saturation = condition.right_saturation = 0xffff;
  return effect;
}

}  // namespace septet::car_io
