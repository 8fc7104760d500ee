#include "engine/scene/pushable_box.hpp"

#include <cmath>
#include <variant>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace septet::scene {
namespace {

/// Sine of the angle within which two axes count as one.
constexpr double same_axis = 1e-9;

template <class T>
const T* body_tag(const Node& node, std::string_view name) {
  const TagValue* value = find_tag(node, solid_group, name);
  return value ? std::get_if<T>(value) : nullptr;
}

/// Of the first leg that turns; 0: there is no such leg.
Vec3 first_turn(const Motion& motion) {
  for (const MotionLeg& leg : motion.legs)
    if (leg.turn_radps != Vec3(0.0)) return leg.turn_radps;
  return Vec3(0.0);
}

}  // namespace

Turning turning_of(const Motion& motion) {
  const Vec3 first_radps = first_turn(motion);
  if (first_radps == Vec3(0.0)) return Turning::upright;
  const Vec3 axis = glm::normalize(first_radps);
  for (const MotionLeg& leg : motion.legs)
    if (glm::length(glm::cross(leg.turn_radps, axis)) > same_axis * glm::length(leg.turn_radps)) return Turning::any;
  if (std::hypot(axis.x, axis.y) <= same_axis) return Turning::upright;
  return std::abs(axis.z) <= same_axis ? Turning::rolling : Turning::any;
}

double box_heading_rad(const Quat& rotation, const Motion& motion) {
  const Turning turning = turning_of(motion);
  if (turning == Turning::any) return 0.0;
  const Vec3 ahead = turning == Turning::rolling ? first_turn(motion) : rotation * Vec3(1.0, 0.0, 0.0);
  // Of what stands on end the heading is any.
  return std::hypot(ahead.x, ahead.y) > 1e-6 ? std::atan2(ahead.y, ahead.x) : 0.0;
}

RigidTransform pose_by_box(const PushableBox& box, const RigidTransform& world_from_box, const Quat& rotation,
                           const Motion& motion) {
  const Quat box_from_upright = glm::angleAxis(-box_heading_rad(rotation, motion), Vec3(0.0, 0.0, 1.0));
  return {world_from_box * -box.foot_m, glm::normalize(world_from_box.orientation * box_from_upright * rotation)};
}

std::optional<PushableBox> pushable_box(const Node& node) {
  const auto* participant = body_tag<std::uint32_t>(node, participant_tag);
  const auto* foot_m = body_tag<Vec3>(node, foot_tag);
  const auto* solid = body_tag<bool>(node, solid_tag);
  if (!participant || !foot_m || !solid || !*solid || !body_tag<double>(node, mass_tag)) return std::nullopt;
  return PushableBox{*participant, *foot_m};
}

}  // namespace septet::scene
