#include "engine/effects/debris/sheet_flow.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/shell.hpp"

namespace septet::debris {
namespace {

using elastic::tetrahedra_per_cell;
using elastic::without_pressure;

/// Mean of the step's stress over a cell: its bending is not in it.
Eigen::Matrix3d stress_of_cell_pa(const elastic::ElasticBody& body, std::size_t cell) {
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  double volume_m3 = 0.0;
  for (std::size_t e = cell * tetrahedra_per_cell; e < (cell + 1) * tetrahedra_per_cell; ++e) {
    sum += body.elements[e].rest_volume_m3 * body.step_stress_pa[e];
    volume_m3 += body.elements[e].rest_volume_m3;
  }
  return sum / volume_m3;
}

double volume_of_cell_m3(const elastic::Shell& shell, std::size_t cell) {
  return shell.cells[cell].size_m.prod() * shell.height_m;
}

/// The membrane's strain of unit size along which a stress of the world makes a cell flow.
Eigen::Vector3d way_of_flow(const elastic::ElasticBody& body, std::size_t cell, const Eigen::Matrix3d& stress_pa) {
  const elastic::Element& middle = body.elements[(cell + 1) * tetrahedra_per_cell - 1];
  const Eigen::Matrix3d f = elastic::deformation_gradient(middle, body.position_m);
  const Eigen::Matrix3d way = without_pressure(f.transpose() * without_pressure(stress_pa) * f).normalized();
  const int first = body.shell.across == 0 ? 1 : 0, second = body.shell.across == 2 ? 1 : 2;
  return {way(first, first), way(second, second), 2.0 * way(first, second)};
}

void flow_under_blow(Piece& piece, const Blow& blow, Flow& result) {
  elastic::ElasticBody& body = piece.body;
  if (!(blow.lost_j > 0.0) || body.step_stress_pa.empty()) return;
  std::vector<std::size_t> struck;
  double struck_volume_m3 = 0.0;
  for (std::size_t k = 0; k < body.shell.cells.size(); ++k) {
    const double von_mises_pa = std::sqrt(1.5) * without_pressure(stress_of_cell_pa(body, k)).norm();
    if (!(blow.stress_factor * von_mises_pa > piece.material.yield_pa)) continue;
    struck.push_back(k);
    struck_volume_m3 += volume_of_cell_m3(body.shell, k);
  }
  if (struck.empty()) return;
  const double flow_stress_pa = std::sqrt(2.0 / 3.0) * piece.material.yield_pa;  // At yield, the deviator's norm.
  // Plane stress stores no more than this by a strain of unit size.
  const double stored_pa = 0.5 * body.material.young_modulus_pa / (1.0 - body.material.poisson_ratio);
  const double strain =
      std::min(most_strain_of_blow, strain_paid_by(blow.lost_j, flow_stress_pa, stored_pa, struck_volume_m3));
  const double before_j = elastic::shell_energy_j(body);
  for (const std::size_t k : struck) {
    const Eigen::Vector3d flowed = strain * way_of_flow(body, k, stress_of_cell_pa(body, k));
    for (elastic::ShellStrain& natural : body.shell.natural[k]) natural.head<3>() += flowed;
    for (std::size_t e = k * tetrahedra_per_cell; e < (k + 1) * tetrahedra_per_cell; ++e)
      piece.plastic_strain[e] += strain;
  }
  const double work_j = struck_volume_m3 * flow_stress_pa * strain;
  result.elements += tetrahedra_per_cell * static_cast<int>(struck.size());
  result.plastic_j += work_j;
  result.paid_j += work_j + elastic::shell_energy_j(body) - before_j;
}

}  // namespace

Flow flow_sheet(Piece& piece, const Blow& blow) {
  Flow result;
  const elastic::ShellFlow bent = elastic::flow_shell(piece.body);
  result.plastic_j = bent.plastic_j;
  for (std::size_t e = 0; e < piece.plastic_strain.size(); ++e) {
    const double strain = bent.strains[e / tetrahedra_per_cell];
    piece.plastic_strain[e] += strain;
    if (strain > 0.0) ++result.elements;
  }
  flow_under_blow(piece, blow, result);
  return result;
}

}  // namespace septet::debris
