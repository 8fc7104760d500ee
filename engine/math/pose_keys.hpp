#pragma once
/// Poses of a body at given times, repeated without end: how an animation moves one thing.
///
/// Between two keys place and scale go evenly, and the body turns evenly about one axis. Two keys of one time are a
/// jump. Units: metres, seconds.

#include <cstddef>
#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace septet {

struct PoseKey {
  float at_s = 0.0f;
  glm::vec3 position_m{0.0f};
  glm::quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  ///< Unit quaternion, w first.
  glm::vec3 scale{1.0f};
  bool operator==(const PoseKey&) const = default;
};
inline constexpr std::size_t max_pose_keys = 1023;

/// The pose at a time, with that time. Until the first key it is the first one's; the last key's time is the period.
/// `keys`: at least one, their times from 0 on and not falling.
PoseKey keyed_pose(std::span<const PoseKey> keys, double time_s);

}  // namespace septet
