#pragma once
/// The static shape of a loaded body: Newton's method on the full energy, geometric stiffness
/// included. For validation of the elements.

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include "engine/physics/elastic/block_cholesky.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"

namespace septet::elastic {

struct EquilibriumReport {
  bool converged = false;
  int iterations = 0;
};

namespace equilibrium {

/// Adds V (g_aᵀ S g_b) I, the geometric stiffness of a stress.
inline void add_geometric_stiffness(const Element& e, const Eigen::Matrix3d& stress_pa, BlockMatrix& matrix) {
  const auto g = shape_gradients(e);
  for_each_block(e, matrix, [&](int a, int b) -> Eigen::Matrix3d {
    return e.rest_volume_m3 * g[a].dot(stress_pa * g[b]) * Eigen::Matrix3d::Identity();
  });
}

/// Stiffness of the whole body; without the geometric part it is always positive definite.
inline BlockMatrix stiffness(const ElasticBody& body, bool geometric) {
  const LameConstants lame = lame_constants(body.material);
  BlockMatrix matrix;
  matrix.set_zero(body.pattern);
  for (const Element& e : body.elements) {
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
    add_stiffness(e, f, lame, 1.0, matrix);
    if (f.determinant() < least_determinant) add_volume_stiffness(e, f, lame.lambda_pa + 2 * lame.mu_pa, matrix);
    if (geometric) add_geometric_stiffness(e, second_piola_stress(green_strain(f), lame), matrix);
  }
  for (int i = 0; i < body.node_count(); ++i) {
    // A weak spring at every node holds a body that is free to turn; it slows Newton's iteration by nothing visible and
    // leaves the equilibrium where it is.
    Block& d = matrix.diagonal[i];
    const double spring = 1e-13 * (d.column[0][0] + d.column[1][1] + d.column[2][2]);
    for (int c = 0; c < 3; ++c) d.column[c][c] += spring;
    for (int s = body.pattern.row_start[i]; s < body.pattern.row_start[i + 1]; ++s)
      if (body.fixed[i] || body.fixed[body.pattern.column[s]]) matrix.lower[s] = zero_block();
    if (!body.fixed[i]) continue;
    matrix.diagonal[i] = zero_block();
    for (int c = 0; c < 3; ++c) matrix.diagonal[i].column[c][c] = 1.0;
  }
  return matrix;
}

inline double potential_j(const ElasticBody& body, const Eigen::Vector3d& gravity) {
  double energy = elastic_energy_j(body);
  for (int i = 0; i < body.node_count(); ++i)
    energy -= (body.force_n[i] + body.mass_kg[i] * gravity).dot(body.position_m[i] - body.rest_position_m[i]);
  return energy;
}

}  // namespace equilibrium

namespace equilibrium {

/// Of an incompressible body, by steps so long that its inertia is nothing: each is an iteration of Newton's without the
/// geometric stiffness.
inline EquilibriumReport by_long_steps(ElasticBody& body, const Eigen::Vector3d& gravity_mps2, int max_iterations) {
  StepSettings settings;
  settings.step_s = 1.0;
  settings.damping_ratio = 0.5;
  settings.gravity_mps2 = gravity_mps2;
  settings.tension_stiffness = settings.follow_spin = false;
  settings.solver = Solver::direct;
  EquilibriumReport report;
  double first_change = 0.0;
  while (report.iterations < max_iterations && !report.converged) {
    ++report.iterations;
    std::ranges::fill(body.velocity_mps, Eigen::Vector3d::Zero());
    step_elastic(body, settings);
    double largest = 0.0;
    for (const auto& v : body.velocity_mps) largest = std::max(largest, settings.step_s * v.norm());
    if (report.iterations == 1) first_change = largest;
    report.converged = largest <= 1e-6 * first_change;
  }
  std::ranges::fill(body.velocity_mps, Eigen::Vector3d::Zero());
  return report;
}

}  // namespace equilibrium

/// Moves the free nodes until `force_n`, gravity and the internal forces balance. Sets the nodes' velocities to zero.
inline EquilibriumReport find_equilibrium(ElasticBody& body, const Eigen::Vector3d& gravity_mps2,
                                          int max_iterations = 40) {
  if (is_incompressible(body.material)) return equilibrium::by_long_steps(body, gravity_mps2, max_iterations);
  EquilibriumReport report;
  std::ranges::fill(body.velocity_mps, Eigen::Vector3d::Zero());
  BlockFactor<double> factor;
  double first_change = 0.0;
  while (report.iterations < max_iterations && !report.converged) {
    ++report.iterations;
    const auto internal = internal_forces_n(body);
    BlockVector move(body.position_m.size(), Eigen::Array4d::Zero());
    for (int i = 0; i < body.node_count(); ++i)
      if (!body.fixed[i]) move[i] = padded(internal[i] + body.force_n[i] + body.mass_kg[i] * gravity_mps2);
    if (!factorise(body.pattern, body.factor_structure, equilibrium::stiffness(body, true), factor) &&
        !factorise(body.pattern, body.factor_structure, equilibrium::stiffness(body, false), factor))
      return report;
    solve(body.factor_structure, factor, move);

    // Halve the step until the potential falls: far from equilibrium a full one may overshoot.
    const auto start = body.position_m;
    const double before = equilibrium::potential_j(body, gravity_mps2);
    double largest = 0.0;
    for (const auto& m : move) largest = std::max(largest, m.matrix().norm());
    if (report.iterations == 1) first_change = largest;
    double part = 1.0;
    for (int halving = 0; halving < 20; ++halving, part *= 0.5) {
      for (int i = 0; i < body.node_count(); ++i) body.position_m[i] = start[i] + part * move[i].head<3>().matrix();
      if (equilibrium::potential_j(body, gravity_mps2) <= before + 1e-9 * std::abs(before)) break;
    }
    report.converged = part == 1.0 && largest <= 1e-8 * first_change;
  }
  return report;
}

/// Moves the free nodes to where `force_n` would take them if strain were small: the strain's square is left out, and so
/// is the change of stiffness with shape. For loads that balance, or a body that is held.
inline bool move_by_small_strain(ElasticBody& body) {
  body.position_m = body.rest_position_m;
  BlockVector move(body.position_m.size(), Eigen::Array4d::Zero());
  for (int i = 0; i < body.node_count(); ++i)
    if (!body.fixed[i]) move[i] = padded(body.force_n[i]);
  BlockFactor<double> factor;
  if (!factorise(body.pattern, body.factor_structure, equilibrium::stiffness(body, false), factor)) return false;
  solve(body.factor_structure, factor, move);
  for (int i = 0; i < body.node_count(); ++i) body.position_m[i] += move[i].head<3>().matrix();
  return true;
}

}  // namespace septet::elastic
