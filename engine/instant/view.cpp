#include "engine/instant/view.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace septet::instant {

Vec3 world_eye(const FrameView& view) { return view.world_from_car * view.projection.eye_m; }

Vec3 ray_through(const FrameView& view, double x_px, double y_px) {
  const OffAxisView& projection = view.projection;
  const double across = x_px / view.viewport.width, down = y_px / view.viewport.height;
  const double right = glm::mix(projection.left_slope, projection.right_slope, view.mirrored ? 1.0 - across : across);
  const double up = glm::mix(projection.top_slope, projection.bottom_slope, down);
  return view.world_from_car.orientation *
         glm::normalize(right * projection.right + up * projection.up - projection.back);
}

}  // namespace septet::instant
