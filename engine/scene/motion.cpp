#include "engine/scene/motion.hpp"

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::scene {
namespace {

Quat turned(const Vec3& turn_radps, double seconds) {
  const double rate_radps = glm::length(turn_radps);
  return rate_radps > 0.0 ? glm::angleAxis(rate_radps * seconds, turn_radps / rate_radps) : Quat(1.0, 0.0, 0.0, 0.0);
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

}  // namespace septet::scene
