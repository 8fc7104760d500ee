#include "engine/physics/elastic/preconditioned_solve.hpp"

#include <algorithm>
#include <cmath>

#include "engine/core/check.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/shell_assembly.hpp"

namespace septet::elastic {
namespace {

/// Errors below this speed (root mean square over the mass) do not matter.
constexpr double speed_tolerance_mps = 1e-8;
/// Largest ratio of stiffness to mass that a factor in single precision may precondition: beyond
/// it, rounding drowns the rigid motion.
constexpr double single_precision_limit = 1e5;

void prepare_rest_factor(ElasticBody& body, const StepSettings& settings) {
  RestFactor& rest = body.rest_factor;
  const double scale = settings.step_s * settings.step_s / gamma_of(settings);
  if (rest.valid && rest.step_scale_s2 == scale) return;
  const LameConstants lame = lame_constants(body.material);
  BlockMatrix matrix;
  matrix.set_zero(body.pattern);
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  if (body.shell.empty())
    for (const Element& e : body.elements) add_stiffness(e, identity, lame, scale, matrix);
  else
    add_rest_stiffness_of_shell(body, scale, matrix);
  double stiffest = 0.0;
  for (int i = 0; i < body.node_count(); ++i) {
    Block& d = matrix.diagonal[i];
    stiffest = std::max(stiffest, (d.column[0][0] + d.column[1][1] + d.column[2][2]) / body.mass_kg[i]);
    for (int c = 0; c < 3; ++c) d.column[c][c] += body.mass_kg[i];
  }
  for (int i = 0; i < body.node_count(); ++i) {
    for (int s = body.pattern.row_start[i]; s < body.pattern.row_start[i + 1]; ++s)
      if (body.fixed[i] || body.fixed[body.pattern.column[s]]) matrix.lower[s] = zero_block();
    if (!body.fixed[i]) continue;
    matrix.diagonal[i] = zero_block();
    for (int c = 0; c < 3; ++c) matrix.diagonal[i].column[c][c] = body.mass_kg[i];
  }
  const bool definite = factorise(body.pattern, body.factor_structure, matrix, rest.in_double);
  SEPTET_CHECK(definite, "the rest shape of {} elements has no factor", body.elements.size());
  rest.single_precision = stiffest < single_precision_limit;
  if (rest.single_precision) {
    rest.in_single = to_single(rest.in_double);
    rest.in_double = {};
  }
  rest.step_scale_s2 = scale;
  rest.valid = true;
}

void precondition(ElasticBody& body) {
  StepWorkspace& w = body.workspace;
  const int n = body.node_count();
  if (body.rest_factor.single_precision) {
    w.single.resize(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector3d r = body.rotation[i].transpose() * w.residual[i].head<3>().matrix();
      w.single[i] = Eigen::Array4d(padded(r)).cast<float>();
    }
    solve(body.factor_structure, body.rest_factor.in_single, w.single);
    for (int i = 0; i < n; ++i)
      w.preconditioned[i] = padded(body.rotation[i] * w.single[i].head<3>().matrix().cast<double>());
    return;
  }
  for (int i = 0; i < n; ++i)
    w.preconditioned[i] = padded(body.rotation[i].transpose() * w.residual[i].head<3>().matrix());
  solve(body.factor_structure, body.rest_factor.in_double, w.preconditioned);
  for (int i = 0; i < n; ++i) w.preconditioned[i] = padded(body.rotation[i] * w.preconditioned[i].head<3>().matrix());
}

double dot(const BlockVector& a, const BlockVector& b) {
  Eigen::Array4d sum = Eigen::Array4d::Zero();
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum.sum();
}

}  // namespace

void follow_rotations(ElasticBody& body) {
  for (int i = 0; i < body.node_count(); ++i) {
    Eigen::Matrix3d mean;
    for (int c = 0; c < 3; ++c) mean.col(c) = body.workspace.mean_deformation[i].column[c].head<3>().matrix();
    const double size = std::cbrt(std::abs(mean.determinant()));
    if (!(mean.determinant() > 0.0) || !(size > 0.2 * mean.norm() / std::sqrt(3.0)))
      continue;  // Flattened or inverted: the last step's rotation is the better guess.
    // Newton's iteration for the polar factor (Higham 1986): Q ← ½(Q + Q⁻ᵀ).
    Eigen::Matrix3d q = mean / size;
    for (int iteration = 0; iteration < 8; ++iteration) {
      const Eigen::Matrix3d c = cofactor(q);
      const Eigen::Matrix3d next = 0.5 * (q + c / q.col(0).dot(c.col(0)));
      const double change = (next - q).squaredNorm();
      q = next;
      if (change < 1e-8) break;
    }
    body.rotation[i] = q;
  }
}

SolveReport preconditioned_solve(ElasticBody& body, const StepSettings& settings) {
  prepare_rest_factor(body, settings);
  StepWorkspace& w = body.workspace;
  const auto n = static_cast<std::size_t>(body.node_count());
  w.residual.resize(n);
  w.preconditioned.resize(n);
  multiply(body.pattern, w.matrix, w.solution, w.image);
  for (std::size_t i = 0; i < n; ++i) w.residual[i] = w.right_side[i] - w.image[i];
  double mass = 0.0;
  for (const double m : body.mass_kg) mass += m;

  SolveReport report;
  precondition(body);
  w.direction = w.preconditioned;
  double error2 = dot(w.residual, w.preconditioned);
  const double enough =
      std::max(settings.tolerance * settings.tolerance * error2, mass * speed_tolerance_mps * speed_tolerance_mps);
  while (error2 > enough && report.iterations < settings.max_iterations) {
    ++report.iterations;
    multiply(body.pattern, w.matrix, w.direction, w.image);
    const double length = error2 / dot(w.direction, w.image);
    for (std::size_t i = 0; i < n; ++i) {
      w.solution[i] += length * w.direction[i];
      w.residual[i] -= length * w.image[i];
    }
    precondition(body);
    const double next = dot(w.residual, w.preconditioned), ratio = next / error2;
    for (std::size_t i = 0; i < n; ++i) w.direction[i] = w.preconditioned[i] + ratio * w.direction[i];
    error2 = next;
  }
  report.converged = error2 <= enough;
  return report;
}

}  // namespace septet::elastic
