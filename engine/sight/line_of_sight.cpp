#include "engine/sight/line_of_sight.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace septet::sight {

std::optional<double> entry_m(const Box& box, const Line& line) {
  const RigidTransform box_from_world = inverse(box.world_from_box);
  const Vec3 begin = box_from_world * line.from_m, way = box_from_world.orientation * line.direction;
  double enters_m = 0.0, leaves_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (std::abs(begin[axis]) > box.half_m[axis]) return std::nullopt;
      continue;
    }
    double near_m = (-box.half_m[axis] - begin[axis]) / way[axis], far_m = (box.half_m[axis] - begin[axis]) / way[axis];
    if (near_m > far_m) std::swap(near_m, far_m);
    enters_m = std::max(enters_m, near_m), leaves_m = std::min(leaves_m, far_m);
  }
  if (enters_m > leaves_m) return std::nullopt;
  return enters_m;
}

}  // namespace septet::sight
