#pragma once
/// Ray of a pixel of a renderer's picture.

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/instant/view.hpp"

namespace septet::instant {

/// Direction from the eye through a place of the viewport, pixels from its upper left (a pixel's middle lies at ½);
/// unit, world axes.
inline Vec3 ray_through(const FrameView& view, double x_px, double y_px) {
  const OffAxisView& projection = view.projection;
  const double across = x_px / view.viewport.width, down = y_px / view.viewport.height;
  const double right = glm::mix(projection.left_slope, projection.right_slope, view.mirrored ? 1.0 - across : across);
  const double up = glm::mix(projection.top_slope, projection.bottom_slope, down);
  return view.world_from_car.orientation *
         glm::normalize(right * projection.right + up * projection.up - projection.back);
}

}  // namespace septet::instant
