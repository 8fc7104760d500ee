#include "engine/scene/motion.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::scene {
namespace {

Quat turned(const Vec3& turn_radps, double seconds) {
  const double rate_radps = glm::length(turn_radps);
  return rate_radps > 0.0 ? glm::angleAxis(rate_radps * seconds, turn_radps / rate_radps) : Quat(1.0, 0.0, 0.0, 0.0);
}

/// Of one axis of a leg: its largest distance from 0 within the leg.
double farthest_m_of(double from_m, double velocity_mps, double acceleration_mps2, double seconds) {
  const auto distance_m = [&](double t) { return std::abs(from_m + t * (velocity_mps + 0.5 * t * acceleration_mps2)); };
  const double turns_back_s = acceleration_mps2 == 0.0 ? 0.0 : -velocity_mps / acceleration_mps2;
  return std::max(distance_m(seconds), distance_m(std::clamp(turns_back_s, 0.0, seconds)));
}

}  // namespace

MovingPose pose_at(const Motion& motion, double simulated_time_s) {
  MovingPose pose{{motion.position_m, motion.rotation}, Vec3(0.0)};
  for (std::size_t i = 0; i < motion.legs.size() && motion.legs[i].from_s < simulated_time_s; ++i) {
    const MotionLeg& leg = motion.legs[i];
    const double end_s =
        i + 1 < motion.legs.size() ? std::min(motion.legs[i + 1].from_s, simulated_time_s) : simulated_time_s;
    const double seconds = end_s - leg.from_s;
    pose.world_from_object.position_m += seconds * (leg.velocity_mps + 0.5 * seconds * leg.acceleration_mps2);
    pose.world_from_object.orientation =
        glm::normalize(turned(leg.turn_radps, seconds) * pose.world_from_object.orientation);
    pose.velocity_mps = leg.velocity_mps + seconds * leg.acceleration_mps2;
    pose.turn_radps = leg.turn_radps;
  }
  return pose;
}

double farthest_coordinate_m(const Motion& motion) {
  double largest_m = 0.0;
  Vec3 position_m = motion.position_m;
  for (int axis = 0; axis < 3; ++axis) largest_m = std::max(largest_m, std::abs(position_m[axis]));
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
