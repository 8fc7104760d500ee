#pragma once
/// Bodies to begin with, and how they are drawn: from a participant to a jointed body and back.
///
/// A person's segments are shares of mass after D. A. Winter (Biomechanics and Motor Control of Human Movement), in the
/// joints of engine/world/limbs.hpp. A machine is a stiff frame of hubs, handlebars, saddle and bottom bracket.

#include "engine/physics/person/jointed_body.hpp"
#include "engine/world/limbs.hpp"

namespace septet::person {

/// A body that stands (rides, is ridden) as the participant at this pose does, and moves with its origin.
JointedBody standing_body(BodyKind kind, double mass_kg, const RigidTransform& world_from_body,
                          const Vec3& velocity_mps);

/// Person on a saddle: the hips at a place in the frame of the machine, the trunk leaned, the feet at the bracket.
JointedBody riding_body(BodyKind machine, double mass_kg, const RigidTransform& world_from_machine,
                        const Vec3& velocity_mps);

/// How a body is drawn: the pose of its participant and, of a person, the angles of the legs (ThrownJoints). A leg is
/// drawn in the trunk's own plane, from the hip to where the foot is, its knee bent forwards.
struct DrawnPose {
  RigidTransform world_from_body;
  Vec3 velocity_mps{0.0}, angular_velocity_radps{0.0};  ///< Of the origin.
  ThrownJoints joints_rad{};
};
DrawnPose drawn_pose(const JointedBody& body);

/// Height of a person's head over the lower of the feet, as a share of standing: 1 upright, 0 lying.
double uprightness(const JointedBody& person);

}  // namespace septet::person
