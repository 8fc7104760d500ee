#pragma once
/// Motions that editors ask for "from now" get the time at which they are done, and the pose that the object has then.

#include <functional>
#include <optional>
#include <span>

#include "engine/math/rigid_transform.hpp"
#include "engine/scene/command.hpp"
#include "engine/scene/store.hpp"

namespace septet::server {

/// Of each MotionSet of the batch with `from_now`. `now_s`: simulated time of the first tick that shows the batch. The
/// pose is that of an earlier command of the batch, else `pushed`'s where it has one, else the store's.
void put_true_times(const scene::Store& store, std::span<scene::Command> batch, double now_s,
                    const std::function<std::optional<RigidTransform>(scene::NodeId)>& pushed = {});

}  // namespace septet::server
