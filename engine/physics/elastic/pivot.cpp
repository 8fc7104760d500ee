#include "engine/physics/elastic/pivot.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

namespace septet::elastic {

std::optional<Pivot> pivot_of(const ElasticBody& body) {
  constexpr double one_place = 1e-9;  // Of the longest arm between fixed nodes, and of a velocity.
  Pivot pivot;
  Eigen::Vector3d longest_m = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) {
    if (!body.fixed[i]) continue;
    if (!pivot.place_m) {
      pivot.place_m = body.position_m[i];
      pivot.velocity_mps = body.velocity_mps[i];
    }
    const Eigen::Vector3d arm_m = body.position_m[i] - *pivot.place_m;
    if (arm_m.squaredNorm() > longest_m.squaredNorm()) longest_m = arm_m;
    if (!(body.velocity_mps[i] - pivot.velocity_mps).isZero(one_place)) return std::nullopt;
  }
  if (longest_m.isZero(0.0)) return pivot;
  const Eigen::Vector3d axis = longest_m.normalized();
  for (int i = 0; i < body.node_count(); ++i)
    if (body.fixed[i] && axis.cross(body.position_m[i] - *pivot.place_m).norm() > one_place * longest_m.norm())
      return std::nullopt;
  pivot.axis = axis;
  return pivot;
}

RigidMotion motion_about(const ElasticBody& body, const Pivot& pivot) {
  if (!pivot.place_m) return rigid_motion(body);
  RigidMotion motion = motion_about(body, *pivot.place_m, pivot.velocity_mps);
  motion.angular_velocity_radps = spin_of(pivot, motion.inertia_kgm2, motion.angular_momentum_nms);
  return motion;
}

Eigen::Vector3d spin_of(const Pivot& pivot, const Eigen::Matrix3d& inertia_kgm2,
                        const Eigen::Vector3d& angular_momentum_nms) {
  if (!pivot.axis) return inertia_kgm2.ldlt().solve(angular_momentum_nms);
  const Eigen::Vector3d& axis = *pivot.axis;
  return axis * (axis.dot(angular_momentum_nms) / axis.dot(inertia_kgm2 * axis));
}

}  // namespace septet::elastic
