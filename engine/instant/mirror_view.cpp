#include "engine/instant/mirror_view.hpp"

#include <glm/geometric.hpp>

namespace septet::instant {

Expected<OffAxisView> mirror_view(const ScreenCorners& glass, const Vec3& eye_m, double radius_m) {
  const auto seen = off_axis_view(glass, eye_m);
  if (!seen) return seen;
  const Vec3 middle_m = 0.5 * (glass.lower_right_m + glass.upper_left_m);
  const Vec3 from_middle_m = eye_m - middle_m;
  const double before_m = glm::dot(from_middle_m, seen->back);
  const double share = radius_m > 0.0 ? 0.5 * radius_m / (before_m + 0.5 * radius_m) : 1.0;
  const Vec3 image_m = middle_m + share * (from_middle_m - 2.0 * before_m * seen->back);
  // Seen from behind the glass, its left side is the right one.
  const Vec3 along_m = glass.lower_right_m - glass.lower_left_m;
  return off_axis_view({glass.lower_right_m, glass.lower_left_m, glass.upper_left_m + along_m}, image_m,
                       share * before_m);
}

}  // namespace septet::instant
