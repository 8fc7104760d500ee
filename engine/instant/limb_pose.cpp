#include "engine/instant/limb_pose.hpp"

#include <cstddef>
#include <numbers>

#include <glm/gtc/quaternion.hpp>

#include "engine/world/limbs.hpp"

namespace septet::instant {
namespace {

using scene::PartRole;

/// Pose of a limb that hangs from `joint`, swung forward by `angle_rad`.
RigidTransform swung(const RigidTransform& joint, double angle_rad) {
  RigidTransform result = joint;
  result.orientation = glm::angleAxis(-angle_rad, Vec3(0, 1, 0)) * result.orientation;
  return result;
}

RigidTransform limb(const RigidTransform& joint, const LegAngles& leg, bool shin) {
  const RigidTransform thigh = swung(joint, leg.thigh_rad);
  if (!shin) return thigh;
  RigidTransform knee = thigh;
  knee.position_m = thigh * Vec3(0, 0, -thigh_m);
  return swung(knee, -leg.knee_rad);
}

/// A limb that is turned about the forward axis through its joint.
RigidTransform aside(const RigidTransform& joint, double angle_rad, const RigidTransform& hanging) {
  const Quat turn = glm::angleAxis(angle_rad, Vec3(1, 0, 0));
  return {joint.position_m + turn * (hanging.position_m - joint.position_m), turn * hanging.orientation};
}

/// Side of a person's part: 0 left, 1 right.
std::size_t side_of(PartRole role) {
  switch (role) {
    case PartRole::leg_right:
    case PartRole::shin_right:
    case PartRole::foot_right:
    case PartRole::arm_right:
      return 1;
    default:
      return 0;
  }
}

/// Pose of a part of a person who walks, stands or was thrown.
RigidTransform walking_part(const scene::Instance& part, const DrawnParticipant& participant) {
  const double phase = participant.wheel_spin_rad;
  const Gait gait{stride_m(strides_hz(participant.speed_mps))};
  const std::size_t side = side_of(part.role);
  const double own_phase = side == 0 ? phase : phase + std::numbers::pi;
  RigidTransform at = part.world_from_object;
  at.position_m.z += walking_hip_m(phase, gait) - hip_height_m;
  if (part.role == PartRole::trunk) return at;
  if (part.role == PartRole::arm_left || part.role == PartRole::arm_right)
    return swung(at, walking_arm_rad(own_phase, gait));
  const double curvature_1pm = walked_curvature_1pm(participant.speed_mps, participant.yaw_rate_radps);
  WalkingLeg leg = walking_leg(own_phase, gait, curvature_1pm, at.position_m.x, at.position_m.y);
  leg.angles.thigh_rad += participant.thrown_rad[side];
  leg.angles.knee_rad += participant.thrown_rad[2 + side];
  if (part.role == PartRole::leg_left || part.role == PartRole::leg_right)
    return aside(at, leg.aside_rad, limb(at, leg.angles, false));
  const RigidTransform shin = aside(at, leg.aside_rad, limb(at, leg.angles, true));
  if (part.role == PartRole::shin_left || part.role == PartRole::shin_right) return shin;
  // The sole's angle is the ground's, not the shin's; a thrown foot hangs from its shin.
  RigidTransform foot = at;
  foot.position_m = shin * Vec3(0, 0, -shin_m);
  foot = swung(foot, participant.thrown_rad[side] - participant.thrown_rad[2 + side] - leg.foot_pitch_rad);
  foot.orientation = glm::angleAxis(leg.foot_turn_rad, Vec3(0, 0, 1)) * foot.orientation;
  return foot;
}

/// Pose of a cyclist's leg or crank.
RigidTransform pedalling_part(const scene::Instance& part, const DrawnParticipant& participant) {
  const RigidTransform& at = part.world_from_object;
  const double phase = participant.wheel_spin_rad, other = phase + std::numbers::pi;
  switch (part.role) {
    case PartRole::pedalling_leg_left:
    case PartRole::pedalling_shin_left:
      return limb(at, pedalling_leg(phase), part.role == PartRole::pedalling_shin_left);
    case PartRole::pedalling_leg_right:
    case PartRole::pedalling_shin_right:
      return limb(at, pedalling_leg(other), part.role == PartRole::pedalling_shin_right);
    default:
      return swung(at, -phase);
  }
}

}  // namespace

bool is_limb(PartRole role) { return role >= PartRole::leg_left; }

RigidTransform vehicle_from_limb(const scene::Instance& part, const DrawnParticipant& participant) {
  if (part.role >= PartRole::pedalling_leg_left && part.role <= PartRole::crank)
    return pedalling_part(part, participant);
  return walking_part(part, participant);
}

}  // namespace septet::instant
