#pragma once
/// Codes of a picture at places of the driver's car.

#include <algorithm>
#include <cstdint>

#include <doctest/doctest.h>
#include <glm/vec4.hpp>

#include "engine/image/image.hpp"
#include "engine/instant/off_axis_view.hpp"

namespace septet {

/// Mean code of one colour in a square of five pixels around a place of the car's frame, in a picture that is this view
/// alone.
inline double mean_code_at(const image::Image& picture, const instant::OffAxisView& view, const Vec3& place_m,
                           std::uint8_t image::Color::*code) {
  const glm::dvec4 clip = view.clip_from_eye_relative * glm::dvec4(place_m - view.eye_m, 1.0);
  const auto x = static_cast<int>((0.5 + 0.5 * clip.x / clip.w) * picture.width);
  const auto y = static_cast<int>((0.5 + 0.5 * clip.y / clip.w) * picture.height);
  constexpr int reach_px = 2;
  REQUIRE(std::min(x, y) >= reach_px);
  REQUIRE(x + reach_px < static_cast<int>(picture.width));
  REQUIRE(y + reach_px < static_cast<int>(picture.height));
  double sum = 0.0;
  int count = 0;
  for (int dy = -reach_px; dy <= reach_px; ++dy)
    for (int dx = -reach_px; dx <= reach_px; ++dx, ++count)
      sum += picture.at(static_cast<std::uint32_t>(x + dx), static_cast<std::uint32_t>(y + dy)).*code;
  return sum / count;
}

inline double green_at(const image::Image& picture, const instant::OffAxisView& view, const Vec3& place_m) {
  return mean_code_at(picture, view, place_m, &image::Color::green);
}

}  // namespace septet
