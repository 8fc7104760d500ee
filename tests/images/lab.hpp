#pragma once
/// Colours as eyes tell them apart.

#include <cmath>
#include <cstdint>

#include <glm/vec3.hpp>

#include "engine/image/image.hpp"
#include "engine/image/srgb.hpp"

namespace septet {

/// CIE L*a*b* of a display's code, white D65.
inline glm::dvec3 lab(const image::Color& code) {
  const auto linear = [](std::uint8_t byte) { return image::light_of_srgb(byte / 255.0); };
  const double r = linear(code.red), g = linear(code.green), b = linear(code.blue);
  const auto root = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = root((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505),
               y = root(0.2126 * r + 0.7152 * g + 0.0722 * b), z = root((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

}  // namespace septet
