#pragma once
/// The fourth corner of a window.

#include "engine/rig/rig.hpp"

namespace septet::rig {

inline Vec3 upper_right_m(const Window& window) {
  return window.lower_right_m + window.upper_left_m - window.lower_left_m;
}

}  // namespace septet::rig
