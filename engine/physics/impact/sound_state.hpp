#pragma once
/// Bounds of a restored impact, whose bytes may come from anywhere: it can be advanced, and ends.

#include <cmath>

#include "engine/physics/impact/engagement.hpp"

namespace septet::impact {

/// What masses and speeds are in every state that was made here.
inline bool is_positive(double value) { return value > 0.0 && std::isfinite(value); }
inline bool is_within(double value, double least, double most) { return value >= least && value <= most; }

inline constexpr double longest_pulse_s = 10.0;

bool is_sound(const Pulse& pulse);
bool is_sound(const Engagement& engagement);

}  // namespace septet::impact
