#include "engine/sight/line_of_sight.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace septet::sight {

std::optional<double> BoxInTheWay::entry_m(const Line& line) const {
  const Vec3 begin = box_from_world_ * line.from_m, way = box_from_world_.orientation * line.direction;
  double enters_m = 0.0, leaves_m = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (way[axis] == 0.0) {
      if (std::abs(begin[axis]) > half_m_[axis]) return std::nullopt;
      continue;
    }
    double near_m = (-half_m_[axis] - begin[axis]) / way[axis], far_m = (half_m_[axis] - begin[axis]) / way[axis];
    if (near_m > far_m) std::swap(near_m, far_m);
    enters_m = std::max(enters_m, near_m), leaves_m = std::min(leaves_m, far_m);
  }
  if (enters_m > leaves_m) return std::nullopt;
  return enters_m;
}

}  // namespace septet::sight
