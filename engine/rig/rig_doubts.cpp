#include "engine/rig/rig_doubts.hpp"

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include <fmt/core.h>
#include <glm/geometric.hpp>

namespace septet::rig {
namespace {

/// Circles are ovals by the same share.
constexpr double most_off_square = 0.05;

struct PixelShape {
  double width_m, height_m, aspect;  ///< Of the window; of one pixel, its width over its height.
};

PixelShape shape_of_pixels(const Screen& screen, const View& view) {
  const double width_m = glm::distance(view.window.lower_left_m, view.window.lower_right_m),
               height_m = glm::distance(view.window.lower_left_m, view.window.upper_left_m);
  return {width_m, height_m,
          (width_m / (screen.width_px * view.width)) / (height_m / (screen.height_px * view.height))};
}

bool is_square(const PixelShape& shape) { return std::abs(shape.aspect - 1.0) <= most_off_square; }

/// Empty where the pixels are square, as nearly as corners are measured.
std::optional<Error> doubt_of_pixels(const Screen& screen, std::string_view file) {
  const PixelShape shape = shape_of_pixels(screen, screen.views.front());
  if (is_square(shape)) return std::nullopt;
  return Error{
      fmt::format("the pixels of the screen {} are {:.2f} times as wide as high: {} × {} pixels on {:.3f} m × {:.3f} m",
                  screen.name, shape.aspect, screen.width_px, screen.height_px, shape.width_m, shape.height_m),
      std::string(file),
      fmt::format("measure its corners again ({:.3f} m of height would fit), or give it {} × {:.0f} pixels",
                  shape.height_m * shape.aspect, screen.width_px, screen.height_px / shape.aspect)};
}

/// `number`: the inset's among those of its screen, from 1.
std::optional<Error> doubt_of_inset(const Screen& screen, std::size_t number, std::string_view file) {
  const View& inset = screen.views[number];
  const PixelShape shape = shape_of_pixels(screen, inset);
  if (is_square(shape)) return std::nullopt;
  return Error{
      fmt::format("the pixels of inset {} of the screen {} are {:.2f} times as wide as high: {:.0f} × {:.0f} pixels "
                  "for {:.3f} m × {:.3f} m",
                  number, screen.name, shape.aspect, screen.width_px * inset.width, screen.height_px * inset.height,
                  shape.width_m, shape.height_m),
      std::string(file), fmt::format("give it height = {:.4f}, or other corners", inset.height / shape.aspect)};
}

}  // namespace

std::vector<Error> doubts_of(const Rig& rig, std::string_view file) {
  std::vector<Error> doubts;
  for (const Screen& screen : rig.screens) {
    const Window& window = screen.views.front().window;
    const Vec3 right = window.lower_right_m - window.lower_left_m, up = window.upper_left_m - window.lower_left_m;
    const Vec3 front = glm::cross(right, up);
    if (glm::dot(rig.eye_point_m - window.lower_left_m, front) <= 0.0)
      doubts.push_back({fmt::format("the screen {} shows its back to the eye point", screen.name), std::string(file),
                        "give its left and right corners as the driver sees them, turned to the screen"});
    else if (up.z < 0.0)
      doubts.push_back({fmt::format("the upper edge of the screen {} lies below its lower edge", screen.name),
                        std::string(file),
                        "exchange upper_left_m and lower_left_m, unless its monitor or projector stands on its head"});
    // An instruments' panel takes the shape of its window, whatever its corners are.
    else if (const auto doubt = screen.only_instruments ? std::nullopt : doubt_of_pixels(screen, file))
      doubts.push_back(*doubt);
    for (std::size_t inset = 1; inset < screen.views.size(); ++inset)
      if (const auto doubt = doubt_of_inset(screen, inset, file)) doubts.push_back(*doubt);
  }
  return doubts;
}

}  // namespace septet::rig
