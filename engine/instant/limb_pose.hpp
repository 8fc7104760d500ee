#pragma once
/// Where the parts of people are who walk, stand, pedal or were thrown (engine/world/limbs.hpp).

#include "engine/instant/frame_input.hpp"
#include "engine/scene/resolved_scene.hpp"

namespace septet::instant {

/// True for parts that move with a person's step or pedals.
bool is_limb(scene::PartRole role);

/// Pose of such a part now, in the frame of its participant.
RigidTransform vehicle_from_limb(const scene::Instance& part, const DrawnParticipant& participant);

}  // namespace septet::instant
