#pragma once
/// Frames and rigid transforms.
///
/// World frame: that of OpenDRIVE and ISO 8855: right-handed, metres, x east, y north, z up. Vehicle frame: x forward,
/// y left, z up, origin on the ground below the middle of the rear axle (OpenSCENARIO 1.3, "Entity"). Angles are
/// radians, heading counter-clockwise from x. A transform `a_from_b` takes coordinates in b to coordinates in a, so
/// that neighbouring names agree: world_from_wheel = world_from_vehicle * vehicle_from_wheel.

#include <cmath>

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

namespace septet {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Quat = glm::dquat;

struct RigidTransform {
  Vec3 position_m{0.0, 0.0, 0.0};
  Quat orientation{1.0, 0.0, 0.0, 0.0};  ///< Unit quaternion, w first.

  Vec3 operator*(const Vec3& point_m) const { return position_m + orientation * point_m; }
  RigidTransform operator*(const RigidTransform& other) const {
    return {*this * other.position_m, orientation * other.orientation};
  }
};

inline RigidTransform inverse(const RigidTransform& a_from_b) {
  const Quat b_from_a = glm::conjugate(a_from_b.orientation);
  return {b_from_a * -a_from_b.position_m, b_from_a};
}

/// Rz(heading) · Ry(pitch) · Rx(roll), the order of OpenDRIVE 1.8 §8 and OpenSCENARIO; positive pitch looks down.
inline Quat orientation_from_angles(double heading_rad, double pitch_rad, double roll_rad) {
  return glm::angleAxis(heading_rad, Vec3(0, 0, 1)) * glm::angleAxis(pitch_rad, Vec3(0, 1, 0)) *
         glm::angleAxis(roll_rad, Vec3(1, 0, 0));
}

/// Heading of the x axis of a frame, in (−π, π].
inline double heading_rad(const Quat& world_from_frame) {
  const Vec3 forward = world_from_frame * Vec3(1, 0, 0);
  return std::atan2(forward.y, forward.x);
}

}  // namespace septet
