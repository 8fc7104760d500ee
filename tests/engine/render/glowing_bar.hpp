#pragma once
/// Glowing bar, drawn across the edge of two screens, and its height at the edge, from the pixels.

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include <doctest/doctest.h>

#include "engine/image/image.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::render {

/// Brighter than everything else at night, so that its pixels are unambiguous.
inline scene::SurfaceMaterial glowing_material() {
  scene::SurfaceMaterial glowing;
  glowing.revision = 1;
  glowing.base_color = glm::vec3(0.0f);
  glowing.emission = glm::vec3(30.0f);
  return glowing;
}

/// The bar is 16 m long in y and 0.1 m thick; its eight corners lie about its middle.
inline constexpr std::uint16_t bar_corners = 8;
inline Vec3 bar_corner_m(std::uint16_t i) { return {i & 1 ? 0.05 : -0.05, i & 2 ? 8.0 : -8.0, i & 4 ? 0.05 : -0.05}; }
inline constexpr std::array<std::array<std::uint16_t, 3>, 12> bar_triangles{{{0, 4, 6},
                                                                             {0, 6, 2},
                                                                             {1, 3, 7},
                                                                             {1, 7, 5},
                                                                             {4, 5, 7},
                                                                             {4, 7, 6},
                                                                             {0, 2, 3},
                                                                             {0, 3, 1},
                                                                             {0, 1, 5},
                                                                             {0, 5, 4},
                                                                             {2, 6, 7},
                                                                             {2, 7, 3}}};

/// Height of the bar in a column: the mean row of bright pixels, weighted.
inline std::optional<double> row_in(const image::Image& picture, std::uint32_t x) {
  double sum = 0.0, weight = 0.0;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    const double bright = std::max(0, int(picture.at(x, y).red) - 60);
    sum += bright * (y + 0.5);
    weight += bright;
  }
  if (weight < 100.0) return std::nullopt;
  return sum / weight;
}

/// The bar's height at a screen's edge, from a straight fit over the columns next to it.
inline double row_at_edge(const image::Image& picture, bool right_edge) {
  constexpr std::uint32_t columns = 40;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::uint32_t i = 0; i < columns; ++i) {
    const double x = i + 0.5;  // Distance from the edge.
    const auto row = row_in(picture, right_edge ? picture.width - 1 - i : i);
    REQUIRE(row.has_value());
    sx += x;
    sy += *row;
    sxx += x * x;
    sxy += x * *row;
  }
  const double slope = (columns * sxy - sx * sy) / (columns * sxx - sx * sx);
  return (sy - slope * sx) / columns;
}

}  // namespace septet::render
