#include "engine/physics/elastic/held_volume.hpp"

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/element.hpp"

namespace septet::elastic {
namespace {

constexpr double enough = 1e-4;         ///< Change of p in a pass, over all of p.
constexpr double least_strain = 1e-10;  ///< Of tr(E); below it p is rounding.

bool holds_volume(const ElasticBody& body) { return is_incompressible(body.material) && body.shell.empty(); }

/// tr(E) + Δt/γ B v.
double trace_ahead(const Element& e, const Eigen::Matrix3d& f, const std::vector<Eigen::Vector3d>& velocity_mps,
                   double lead_s) {
  return green_strain(f).trace() + lead_s * f.cwiseProduct(deformation_gradient(e, velocity_mps)).sum();
}

/// Calls add(node, impulse) with the impulse of a stress p on each node of the element.
template <class Add>
void for_each_impulse(const Element& e, const Eigen::Matrix3d& f, double stress_pa, double dt, const Add& add) {
  const Eigen::Matrix3d impulse = -dt * e.rest_volume_m3 * stress_pa * f * e.rest_inverse.transpose();
  add(e.nodes[0], -impulse.rowwise().sum());
  for (int a = 0; a < 3; ++a) add(e.nodes[static_cast<std::size_t>(a) + 1], impulse.col(a));
}

}  // namespace

void release_volume(ElasticBody& body) {
  if (!holds_volume(body)) return;
  body.volume_stress_pa.assign(body.elements.size(), 0.0);
  body.workspace.held_stress_pa.assign(body.elements.size(), 0.0);
}

bool hold_volume(ElasticBody& body, const StepSettings& settings) {
  if (!holds_volume(body)) return false;
  StepWorkspace& w = body.workspace;
  const double lambda_pa = lame_constants(body.material).lambda_pa, lead_s = settings.step_s / gamma_of(settings);
  std::vector<Eigen::Vector3d> solved_mps;
  solved_mps.reserve(w.solution.size());
  for (const Eigen::Array4d& v : w.solution) solved_mps.emplace_back(v.head<3>().matrix());
  double change = 0.0, whole = 0.0;
  for (std::size_t k = 0; k < body.elements.size(); ++k) {
    const Element& e = body.elements[k];
    const double gained_pa = lambda_pa * trace_ahead(e, deformation_gradient(e, body.position_m), solved_mps, lead_s);
    body.volume_stress_pa[k] = w.held_stress_pa[k] + gained_pa;
    change += e.rest_volume_m3 * gained_pa * gained_pa;
    whole += e.rest_volume_m3 * (body.volume_stress_pa[k] * body.volume_stress_pa[k] +
                                 lambda_pa * lambda_pa * least_strain * least_strain / (enough * enough));
  }
  if (!(change > enough * enough * whole)) return false;
  for (std::size_t k = 0; k < body.elements.size(); ++k) {
    const Element& e = body.elements[k];
    for_each_impulse(e, deformation_gradient(e, body.position_m), body.volume_stress_pa[k] - w.held_stress_pa[k],
                     settings.step_s, [&](int node, const Eigen::Vector3d& impulse_ns) {
                       if (!body.fixed[node]) w.right_side[node] += padded(impulse_ns);
                     });
    w.held_stress_pa[k] = body.volume_stress_pa[k];
  }
  return true;
}

Eigen::Matrix3d stress_at_pa(const ElasticBody& body, int element, const Eigen::Matrix3d& strain) {
  const LameConstants lame = lame_constants(body.material);
  const Eigen::Matrix3d stress = second_piola_stress(strain, lame);
  if (!holds_volume(body) || body.volume_stress_pa.empty()) return stress;
  return stress + (body.volume_stress_pa[element] - lame.lambda_pa * strain.trace()) * Eigen::Matrix3d::Identity();
}

void add_held_impulses(const ElasticBody& before, const ElasticBody& after, double step_s,
                       std::vector<Eigen::Vector3d>& impulse_ns) {
  if (!holds_volume(before)) return;
  for (std::size_t k = 0; k < before.elements.size(); ++k) {
    const Element& e = before.elements[k];
    for_each_impulse(e, deformation_gradient(e, before.position_m), after.workspace.held_stress_pa[k], step_s,
                     [&](int node, const Eigen::Vector3d& impulse) { impulse_ns[node] += impulse; });
  }
}

}  // namespace septet::elastic
