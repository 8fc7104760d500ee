#pragma once
/// Incompressible solids: Poisson's ratio of one half.
///
/// In eq. 20 of Servin et al. such a material is nothing special: its compliance α is finite, with a zero where λ is
/// infinite, and the multiplier of that row is a stress that keeps the volume, p = lim λ tr(E). The primal form has no
/// such limit. So that row stays mixed: each element keeps its own p, and a step is to satisfy
///     A v = b − Δt Bᵀp,   tr(E) + Δt/γ B v = 0,
/// with A and b without λ, and B v the rate of tr(E). The method of multipliers finds p with the primal matrix of a
/// finite λ and its one factor: p ← p + λ (tr(E) + Δt/γ B v), then v anew. It asks nothing of the rank of B, which
/// linear tetrahedra overburden. Each step begins with p = 0, so that no part of p without a force gathers.
///
/// tr(E) = 0 keeps the volume of small strain: at 1 % of stretch it lacks 1.5e-4 of it, at 10 % 1.6e-2.

#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"

namespace septet::elastic {

/// Call before the first solution of a step. Does nothing to a material that is compressible.
void release_volume(ElasticBody& body);

/// After a solution for velocities: sets the stresses p from it. True where they have changed by more than a
/// ten-thousandth; the right side has their impulses then, and is to be solved again.
bool hold_volume(ElasticBody& body, const StepSettings& settings);

/// Second Piola–Kirchhoff stress of an element at a strain, with p for λ tr(E) in an incompressible solid.
Eigen::Matrix3d stress_at_pa(const ElasticBody& body, int element, const Eigen::Matrix3d& strain);

/// Adds the impulses on the nodes by p that the last solution of a step had in its right side. `before` is the body
/// before the step, `after` that after it, whose workspace still has its solution.
void add_held_impulses(const ElasticBody& before, const ElasticBody& after, double step_s,
                       std::vector<Eigen::Vector3d>& impulse_ns);

}  // namespace septet::elastic
