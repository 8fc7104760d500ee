#include "engine/math/pose_keys.hpp"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>

#include "engine/math/spherical_interpolation.hpp"

namespace septet {

PoseKey keyed_pose(std::span<const PoseKey> keys, double time_s) {
  const double period_s = static_cast<double>(keys.back().at_s);
  const double at_s = period_s > 0.0 ? std::fmod(std::max(time_s, 0.0), period_s) : 0.0;
  const auto after = std::ranges::upper_bound(keys, at_s, {}, [](const PoseKey& key) { return double{key.at_s}; });
  PoseKey pose = after == keys.begin() ? keys.front() : *(after - 1);
  if (after != keys.begin() && after != keys.end()) {
    const double share = (at_s - double{pose.at_s}) / (double{after->at_s} - double{pose.at_s});
    pose.position_m = glm::mix(pose.position_m, after->position_m, static_cast<float>(share));
    pose.rotation = glm::quat(slerp_quadratic(Quat(pose.rotation), Quat(after->rotation), 0.0, share));
    pose.scale = glm::mix(pose.scale, after->scale, static_cast<float>(share));
  }
  pose.at_s = static_cast<float>(at_s);
  return pose;
}

}  // namespace septet
