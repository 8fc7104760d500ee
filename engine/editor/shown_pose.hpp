#pragma once
/// Where an object is at a tick, as screens draw it: a motion leads it on, and pushes move it.

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/node.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::editor {

/// In its parent's frame, metres. `node` is an object.
RigidTransform shown_pose(const scene::Node& node, const Snapshot& snapshot);

}  // namespace septet::editor
