#pragma once
/// Transfer function of sRGB (IEC 61966-2-1): codes of a display and linear light, both from 0 to 1. Pure functions; any thread.

#include <cmath>
#include <concepts>

namespace septet::image {

template <std::floating_point T>
T light_of_srgb(T code) {
  return code <= T(0.04045) ? code / T(12.92) : std::pow((code + T(0.055)) / T(1.055), T(2.4));
}

template <std::floating_point T>
T srgb_of_light(T light) {
  return light <= T(0.0031308) ? T(12.92) * light : T(1.055) * std::pow(light, T(1.0) / T(2.4)) - T(0.055);
}

}  // namespace septet::image
