#pragma once
/// The instruments of the car with a drawn interior (the Volvo S80): place of the panel and layout on it, so that the
/// scenery paints the faces and a frame puts needles and lamps on them.
///
/// On the panel, metres from its middle: x to the right and y up as the driver sees it. Its normal points at the
/// driver's eyes.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/vec2.hpp>

#include "engine/math/rigid_transform.hpp"

namespace septet::instrument_panel {

/// Vehicle frame.
inline constexpr Vec3 middle_m{1.95, 0.37, 0.969}, right{0.0, -1.0, 0.0}, up{0.317, 0.0, 0.94843},
    normal{-0.94843, 0.0, 0.317};
inline constexpr double width_m = 0.30, height_m = 0.115;

struct Dial {
  glm::dvec2 middle_m;
  double radius_m, full;  ///< The reading at the end of its scale.
};
inline constexpr Dial revolutions{{-0.093, 0.0}, 0.052, 8.0};  ///< Thousands a minute.
inline constexpr Dial speed{{0.093, 0.0}, 0.052, 260.0};       ///< km/h.

/// Angle of the needle: radians from the panel's x, counter-clockwise. It runs by the clock from lower left to lower
/// right and stops at both ends.
inline double needle_rad(const Dial& dial, double reading) {
  const double share = reading > 0.0 ? std::min(reading / dial.full, 1.0) : 0.0;
  return (1.25 - 1.5 * share) * std::numbers::pi;
}

/// Pictures of one image, `columns` in each of `rows` rows.
enum class Sign : std::uint8_t {
  zero,  ///< The ten digits in their order.
  nine = 9,
  reverse,
  neutral,
  indicator_left,
  indicator_right,
  hazard,
  low_beam,
  high_beam,
  rear_fog,
  parking_brake,
  engine,
  needle,  ///< Plain, as the next.
  hub,
};
inline constexpr std::uint32_t columns = 8, rows = 3;

/// Cell of a sign's picture: column and row, the first row on top.
constexpr glm::uvec2 cell_of(Sign sign) {
  const auto index = static_cast<std::uint32_t>(sign);
  return {index % columns, index / columns};
}
/// The middle of a sign's picture in texture coordinates.
inline glm::vec2 uv_of_middle(Sign sign) { return (glm::vec2(cell_of(sign)) + 0.5f) / glm::vec2(columns, rows); }

/// A sign on the panel, as high as `height_m`.
struct Place {
  glm::dvec2 middle_m;
  double height_m;
};
inline constexpr Place gear{{0.0, -0.004}, 0.034}, speed_digits{{0.093, -0.030}, 0.015};
/// Place of a lamp on the panel.
constexpr Place place_of(Sign sign) {
  constexpr double lamp_m = 0.018;
  switch (sign) {
    case Sign::indicator_left:
      return {{-0.026, 0.042}, lamp_m};
    case Sign::indicator_right:
      return {{0.026, 0.042}, lamp_m};
    case Sign::hazard:
      return {{0.0, 0.042}, lamp_m};
    case Sign::low_beam:
      return {{-0.026, 0.019}, lamp_m};
    case Sign::high_beam:
      return {{0.026, 0.019}, lamp_m};
    case Sign::rear_fog:
      return {{-0.026, -0.046}, lamp_m};
    case Sign::parking_brake:
      return {{0.026, -0.046}, lamp_m};
    default:
      return {{0.0, -0.046}, lamp_m};
  }
}

}  // namespace septet::instrument_panel
