#pragma once
/// Conjugate gradients for the stepper's matrix, preconditioned by its Cholesky factor at rest.
///
/// The factor of M + Δt²/γ K(rest) is made once. A body that has turned or is bent is preconditioned through the
/// rotation of each node (the polar part of its elements' mean F): z = R L⁻ᵀ L⁻¹ Rᵀ r. Two to seven iterations then
/// suffice where Jacobi's preconditioner needs hundreds.

#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

struct SolveReport {
  int iterations = 0;
  bool converged = false;
};

/// Updates the nodes' rotations from the workspace's mean deformation gradients.
void follow_rotations(ElasticBody& body);

/// Solves the workspace's system, with its present solution as first guess.
SolveReport preconditioned_solve(ElasticBody& body, const StepSettings& settings);

}  // namespace septet::elastic
