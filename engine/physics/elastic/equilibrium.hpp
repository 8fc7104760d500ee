#pragma once
/// The static shape of a loaded body: Newton's method on the full energy, geometric stiffness
/// included. For validation, and for bodies that should start at rest under their weight.

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

struct EquilibriumReport {
  bool converged = false;
  int iterations = 0;
};

/// Moves the free nodes until `force_n`, gravity and the internal forces balance. Sets the nodes' velocities to zero.
EquilibriumReport find_equilibrium(ElasticBody& body, const Eigen::Vector3d& gravity_mps2, int max_iterations = 40);

}  // namespace septet::elastic
