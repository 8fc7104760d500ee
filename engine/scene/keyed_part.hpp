#pragma once
/// Parts that move by keys: their object, or one above it, has the tags `keys/0`, `keys/1`, … of the group `draw`
/// (CONVENTIONS.md). The pose of any instant follows from them, so nothing is sent or logged while they move.

#include <memory>
#include <optional>
#include <vector>

#include "engine/math/pose_keys.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/scene/node.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::scene {

/// A pose and what lengths in it are multiplied by.
struct ScaledPose {
  RigidTransform pose;
  glm::vec3 scale{1.0f};
};
/// Scales go by axes: a scaled parent turns no child's right angles into others.
ScaledPose child_of(const ScaledPose& parent, const RigidTransform& parent_from_child, const glm::vec3& scale);

struct KeyedPart {
  ScaledPose above;           ///< Of the parent of the keyed object; above.pose: root_from_parent.
  ScaledPose below;           ///< Of the part in the keyed object; below.pose: keyed_from_part.
  std::vector<PoseKey> keys;  ///< parent_from_keyed; at least one.
};

/// The instance as it stands at a time; empty for one without keys.
std::optional<Instance> moved(const Instance& instance, double simulated_time_s);

/// Tags that hold the keys, of which at most `max_pose_keys` are written.
std::vector<Tag> tags_of_keys(const std::vector<PoseKey>& keys);
/// The keys of an object; none where a tag is not of this form, has a number that is not finite or out of
/// its bound (world_bounds.hpp), or a time falls.
std::vector<PoseKey> keys_of(const Node& object);

}  // namespace septet::scene
