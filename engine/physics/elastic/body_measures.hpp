#pragma once
/// Measures of an elastic body: energies, momenta, stresses.

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

double total_mass_kg(const ElasticBody& body);
double kinetic_energy_j(const ElasticBody& body);
double elastic_energy_j(const ElasticBody& body);
Eigen::Vector3d centre_of_mass_m(const ElasticBody& body);
Eigen::Vector3d momentum_ns(const ElasticBody& body);
/// About the world's origin.
Eigen::Vector3d angular_momentum_nms(const ElasticBody& body);

/// The rigid motion with the body's mass, momentum and angular momentum.
struct RigidMotion {
  Eigen::Vector3d centre_m, velocity_mps, angular_velocity_radps;
  Eigen::Vector3d angular_momentum_nms;  ///< About the centre.
  Eigen::Matrix3d inertia_kgm2;          ///< About the centre.
};
RigidMotion rigid_motion(const ElasticBody& body);
/// The same about another place that moves with `velocity_mps`.
RigidMotion motion_about(const ElasticBody& body, const Eigen::Vector3d& centre_m, const Eigen::Vector3d& velocity_mps);

/// Cauchy stress of one element, σ = F S Fᵀ / det F.
Eigen::Matrix3d cauchy_stress_pa(const ElasticBody& body, int element);

}  // namespace septet::elastic
