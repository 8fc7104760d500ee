#include "engine/scene/motion_reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace septet::scene {
namespace {

/// Of one axis of a leg: its largest distance from 0 within the leg, at an end or where it turns back.
double farthest_m_of(double from_m, double velocity_mps, double acceleration_mps2, double seconds) {
  const auto distance_m = [&](double t) { return std::abs(from_m + t * (velocity_mps + 0.5 * t * acceleration_mps2)); };
  const double turns_back_s = acceleration_mps2 == 0.0 ? 0.0 : -velocity_mps / acceleration_mps2;
  return std::max(distance_m(seconds), distance_m(std::clamp(turns_back_s, 0.0, seconds)));
}

}  // namespace

double farthest_coordinate_m(const Motion& motion) {
  Vec3 position_m = motion.position_m;
  double largest_m = std::max({std::abs(position_m.x), std::abs(position_m.y), std::abs(position_m.z)});
  for (std::size_t i = 0; i + 1 < motion.legs.size(); ++i) {
    const MotionLeg& leg = motion.legs[i];
    const double seconds = motion.legs[i + 1].from_s - leg.from_s;
    for (int axis = 0; axis < 3; ++axis)
      largest_m = std::max(
          largest_m, farthest_m_of(position_m[axis], leg.velocity_mps[axis], leg.acceleration_mps2[axis], seconds));
    position_m += seconds * (leg.velocity_mps + 0.5 * seconds * leg.acceleration_mps2);
  }
  return largest_m;
}

}  // namespace septet::scene
