#pragma once
/// Image of a point in a mirror, found without the law of reflection: light takes the shortest path (Fermat).

#include <cmath>

#include <glm/geometric.hpp>

#include "engine/instant/off_axis_view.hpp"

namespace septet::instant {

/// Place on the glass with the shortest path from the eye over it to the point, found by stepping; radius 0: flat.
inline Vec3 reflection_point(const ScreenCorners& corners, double radius_m, const Vec3& eye_m, const Vec3& point_m) {
  const Vec3 along = corners.lower_right_m - corners.lower_left_m, upward = corners.upper_left_m - corners.lower_left_m;
  const Vec3 right = glm::normalize(along), up = glm::normalize(upward),
             back = glm::normalize(glm::cross(along, upward));
  const Vec3 middle_m = 0.5 * (corners.lower_right_m + corners.upper_left_m);
  const auto on_glass = [&](double x, double y) {
    const double deep_m = radius_m > 0.0 ? radius_m - std::sqrt(radius_m * radius_m - x * x - y * y) : 0.0;
    return middle_m + x * right + y * up - deep_m * back;
  };
  const auto length_m = [&](double x, double y) {
    const Vec3 place = on_glass(x, y);
    return glm::distance(eye_m, place) + glm::distance(place, point_m);
  };
  double x = 0.0, y = 0.0;
  for (double step_m = 0.1; step_m > 1e-10; step_m *= 0.5)
    for (bool better = true; better;) {
      better = false;
      for (const Vec2& way : {Vec2(step_m, 0), Vec2(-step_m, 0), Vec2(0, step_m), Vec2(0, -step_m)})
        if (length_m(x + way.x, y + way.y) < length_m(x, y) - 1e-16) {
          x += way.x;
          y += way.y;
          better = true;
        }
    }
  return on_glass(x, y);
}

}  // namespace septet::instant
