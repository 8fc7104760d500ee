#pragma once
/// Effects loaded into a wheel's own force feedback (Linux' evdev): constant force, and effects that the wheel computes
/// itself a thousand times a second, too fast for a program: a spring to its middle, a damper, friction.
///
/// Each effect ends by itself after 250 ms unless it is played again: the driver's own watchdog, for a program that
/// hangs. Pure functions.

#include <cstdint>

struct ff_effect;

namespace septet::car_io {

inline constexpr std::uint16_t effect_ends_after_ms = 250;

/// Shares of the motor's full force: of the spring at the end of the wheel's travel, of the damper at its fastest, of
/// friction.
struct WheelFeel {
  double spring = 0.0, damper = 0.0, friction = 0.0;
  bool operator==(const WheelFeel&) const = default;
};

/// −1 (right) to 1 (left). `id` −1: a new one.
ff_effect constant_effect(double force, std::int16_t id);
/// `type`: FF_SPRING, FF_DAMPER or FF_FRICTION.
ff_effect condition_effect(std::uint16_t type, double share, std::int16_t id);

}  // namespace septet::car_io
