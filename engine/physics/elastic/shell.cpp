#include "engine/physics/elastic/shell.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/shell_cell.hpp"

namespace septet::elastic {
namespace {

std::array<int, 2> axes_along(const Shell& shell) { return {shell.across == 0 ? 1 : 0, shell.across == 2 ? 1 : 2}; }

/// The brick of five tetrahedra from `first` on; false where they make up none.
bool find_cell(const ElasticBody& body, std::size_t first, ShellCell& cell) {
  std::vector<int> nodes;
  for (std::size_t e = first; e < first + tetrahedra_per_cell; ++e)
    nodes.insert(nodes.end(), body.elements[e].nodes.begin(), body.elements[e].nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  if (nodes.size() != cell.nodes.size()) return false;
  const auto place = [&](int node) { return body.rest_position_m[static_cast<std::size_t>(node)]; };
  Eigen::AlignedBox3d box;
  for (const int node : nodes) box.extend(place(node));
  const auto axes = axes_along(body.shell);
  cell.nodes.fill(-1);
  for (const int node : nodes) {
    const Eigen::Vector3d from_middle = place(node) - box.center();
    const std::size_t corner = (from_middle[axes[0]] > 0.0 ? 1U : 0U) + (from_middle[axes[1]] > 0.0 ? 2U : 0U) +
                               (from_middle[body.shell.across] > 0.0 ? 4U : 0U);
    if (cell.nodes[corner] >= 0) return false;
    cell.nodes[corner] = node;
  }
  cell.size_m = {box.sizes()[axes[0]], box.sizes()[axes[1]]};
  return true;
}

/// Von Mises of a plane stress, or of a moment.
double von_mises(const Eigen::Vector3d& s) {
  return std::sqrt(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2]);
}

/// Force and moment over what makes the section flow through, together.
double share_carried(const Shell& shell, const ShellStrain& load) {
  return std::hypot(von_mises(load.head<3>()) / shell.yield_npm, von_mises(load.tail<3>()) / shell.plastic_moment_n());
}

/// The axes of a sheet at rest, turned with the middle of a cell.
Eigen::Matrix3d axes_of(const Shell& shell, const ShellVectors& u) {
  const auto axes = axes_along(shell);
  Eigen::Matrix3d now;
  const Eigen::Vector3d first = u.col(0).normalized(), out = u.col(0).cross(u.col(1)).normalized();
  now.col(axes[0]) = first;
  now.col(axes[1]) = out.cross(first);
  now.col(shell.across) = out;
  return now;
}

}  // namespace

void derive_cells(ElasticBody& body) {
  Shell& shell = body.shell;
  shell.cells.clear();
  if (!(shell.thickness_m > 0.0) || body.elements.size() % tetrahedra_per_cell != 0) return;
  for (std::size_t first = 0; first < body.elements.size(); first += tetrahedra_per_cell) {
    if (find_cell(body, first, shell.cells.emplace_back())) continue;
    shell.cells.clear();
    return;
  }
  if (shell.natural.empty()) {
    CellStrain flat;
    flat.fill(ShellStrain::Zero());
    shell.natural.assign(shell.cells.size(), flat);
  }
}

double shell_energy_j(const ElasticBody& body) {
  double energy_j = 0.0;
  for_each_sample(body, body.position_m, [&](const ShellCell&, const auto& sample) {
    energy_j += 0.5 * sample.strain.dot(sample.stress_j());
  });
  return energy_j;
}

Eigen::Matrix3d shell_stress_pa(const ElasticBody& body, int element, double lead_s) {
  const Shell& shell = body.shell;
  const auto k = static_cast<std::size_t>(element) / tetrahedra_per_cell;
  const ShellCell& cell = shell.cells[k];
  const CellPlaces x = places_of(cell, body.position_m), v = places_of(cell, body.velocity_mps);
  ShellStrain strain = ShellStrain::Zero();
  const auto places = gauss_places();
  for (std::size_t p = 0; p < places.size(); ++p) {
    const auto sample = bending_sample(shell, cell, body.material, x, places[p], shell.natural[k][p]);
    strain += 0.25 * (sample.strain + lead_s * sample.jacobian.transpose() * v.reshaped());
  }
  const Eigen::Vector3d stress_pa = membrane_stiffness_npm(shell, body.material) * strain.head<3>() / shell.height_m;
  const auto axes = axes_along(shell);
  Eigen::Matrix3d at_rest = Eigen::Matrix3d::Zero();
  at_rest(axes[0], axes[0]) = stress_pa[0];
  at_rest(axes[1], axes[1]) = stress_pa[1];
  at_rest(axes[0], axes[1]) = at_rest(axes[1], axes[0]) = stress_pa[2];
  const Eigen::Matrix3d now = axes_of(shell, x * rows_at(shell, cell, 0.0, 0.0).transpose());
  return now * at_rest * now.transpose();
}

ShellFlow flow_shell(ElasticBody& body) {
  ShellFlow flow;
  Shell& shell = body.shell;
  if (!(shell.yield_npm > 0.0)) return flow;
  flow.strains.assign(shell.cells.size(), 0.0);
  const auto section = section_stiffness(shell, body.material);
  const auto places = gauss_places();
  for (std::size_t k = 0; k < shell.cells.size(); ++k) {
    const CellPlaces x = places_of(shell.cells[k], body.position_m);
    for (std::size_t p = 0; p < places.size(); ++p) {
      ShellStrain& natural = shell.natural[k][p];
      const auto sample = bending_sample(shell, shell.cells[k], body.material, x, places[p], natural);
      const ShellStrain load = section * sample.strain;
      const double over = share_carried(shell, load);
      if (!(over > 1.0)) continue;
      const double share = 1.0 - 1.0 / over;
      const ShellStrain flowed = share * sample.strain;
      natural += flowed;
      flow.plastic_j += (1.0 - 0.5 * share) * flowed.dot(sample.stress_j());
      flow.strains[k] =
          std::max(flow.strains[k], flowed.head<3>().norm() + 0.5 * shell.thickness_m * flowed.tail<3>().norm());
    }
  }
  return flow;
}

}  // namespace septet::elastic
