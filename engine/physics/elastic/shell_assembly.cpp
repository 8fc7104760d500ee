#include "engine/physics/elastic/shell_assembly.hpp"

#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>

#include "engine/physics/elastic/shell_cell.hpp"

namespace septet::elastic {
namespace {

using CellMatrix = Eigen::Matrix<double, 24, 24>;
using PairMatrix = Eigen::Matrix<double, 8, 8>;

/// Geometric stiffness of a sample's stress, its part that holds: for each pair of nodes a number, the same along all
/// axes. Nothing where the stress is too small to be unstable beside the mass `cell_kg` (tension_limit of assembly.cpp).
template <int count>
std::optional<PairMatrix> tension_of(const Shell& shell, const ShellCell& cell, const ShellSample<count>& sample,
                                     double step_s, double cell_kg) {
  // Rows in like units, so that the part that holds is not larger than it need be.
  const double length_m = std::sqrt(cell.size_m.prod()), h = shell.height_m;
  Eigen::Matrix<double, 5, 1> unit;
  if constexpr (count == 1)
    unit << std::sqrt(length_m / h), std::sqrt(length_m / h), 0.5 * h, 0.5 * h, std::sqrt(h / length_m);
  else
    unit << 1.0, 1.0, 0.5 * h, 0.5 * h, 0.5 * h;
  const auto stress_j = sample.stress_j();
  Eigen::Matrix<double, 5, 5> form = Eigen::Matrix<double, 5, 5>::Zero();
  for (std::size_t k = 0; k < count; ++k)
    for (const auto& [p, q] : {sample.first_pair[k], sample.second_pair[k]}) {
      if (p < 0) continue;
      const double s = stress_j[static_cast<Eigen::Index>(k)] / (unit[p] * unit[q]);
      form(p, q) += s;
      if (p != q) form(q, p) += s;
    }
  const ShellRows rows = unit.asDiagonal() * sample.rows;
  if (form.norm() * rows.squaredNorm() * step_s * step_s < cell_kg) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 5, 5>> eigen(form);
  const Eigen::Matrix<double, 5, 1> pulls = eigen.eigenvalues().cwiseMax(0.0);
  return rows.transpose() * eigen.eigenvectors() * pulls.asDiagonal() * eigen.eigenvectors().transpose() * rows;
}

}  // namespace

void assemble_shell(ElasticBody& body, const StepSettings& settings, StepReport& report) {
  StepWorkspace& w = body.workspace;
  const Shell& shell = body.shell;
  const double dt = settings.step_s, scale = dt * dt / gamma_of(settings);
  for (std::size_t k = 0; k < shell.cells.size(); ++k) {
    const ShellCell& cell = shell.cells[k];
    const CellPlaces x = places_of(cell, body.position_m), v = places_of(cell, body.velocity_mps);
    const double cell_kg = body.material.density_kgpm3 * cell.size_m.prod() * shell.height_m;
    CellMatrix stiffness = CellMatrix::Zero();
    CellPlaces impulse_ns = CellPlaces::Zero();
    for_each_sample(shell, cell, shell.natural[k], body.material, x, [&](const auto& sample) {
      stiffness.noalias() += scale * sample.jacobian * sample.stiffness_j * sample.jacobian.transpose();
      impulse_ns.reshaped() -= dt * sample.jacobian * sample.stress_j();
      if (!settings.tension_stiffness) return;
      const auto tension = tension_of(shell, cell, sample, dt, cell_kg);
      if (!tension) return;
      ++report.under_tension;
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < 8; ++b) stiffness.block<3, 3>(3 * a, 3 * b).diagonal().array() += scale * (*tension)(a, b);
      // On the change of velocity, so that spin is not slowed.
      impulse_ns += scale * v * *tension;
    });
    add_cell_blocks(cell, stiffness, w.matrix);
    for (int a = 0; a < 8; ++a)
      w.right_side[static_cast<std::size_t>(cell.nodes[static_cast<std::size_t>(a)])] += padded(impulse_ns.col(a));
  }
}

void add_rest_stiffness_of_shell(const ElasticBody& body, double scale, BlockMatrix& matrix) {
  for_each_sample(body, body.rest_position_m, [&](const ShellCell& cell, const auto& sample) {
    add_cell_blocks(cell, scale * sample.jacobian * sample.stiffness_j * sample.jacobian.transpose(), matrix);
  });
}

}  // namespace septet::elastic
