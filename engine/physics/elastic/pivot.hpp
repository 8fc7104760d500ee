#pragma once
/// The place about which a body turns as a whole: its mass centre, or where its fixed nodes hold it.

#include <optional>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

/// A free body turns about its mass centre, one that is fixed at a point about that, one that is fixed along a line about
/// that axis.
struct Pivot {
  std::optional<Eigen::Vector3d> place_m;  ///< Of fixed nodes; the mass centre where there is none.
  Eigen::Vector3d velocity_mps{0.0, 0.0, 0.0};
  std::optional<Eigen::Vector3d> axis;  ///< Unit length.
};

/// Nothing where fixed nodes span a surface or move apart: the body cannot turn.
std::optional<Pivot> pivot_of(const ElasticBody& body);

/// The motion about the pivot, its spin such as the pivot leaves.
RigidMotion motion_about(const ElasticBody& body, const Pivot& pivot);

/// The spin of this angular momentum about the pivot.
Eigen::Vector3d spin_of(const Pivot& pivot, const Eigen::Matrix3d& inertia_kgm2,
                        const Eigen::Vector3d& angular_momentum_nms);

/// Of what turns with the motion, at a place.
inline Eigen::Vector3d centrifugal_mps2(const RigidMotion& motion, const Eigen::Vector3d& place_m) {
  const Eigen::Vector3d& spin_radps = motion.angular_velocity_radps;
  return -spin_radps.cross(spin_radps.cross(place_m - motion.centre_m));
}

}  // namespace septet::elastic
