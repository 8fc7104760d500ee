#include "engine/physics/elastic/step_energy.hpp"

#include <algorithm>
#include <optional>

#include <Eigen/Geometry>

#include "engine/physics/elastic/assembly.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/held_volume.hpp"
#include "engine/physics/elastic/pivot.hpp"
#include "engine/physics/elastic/shell_cell.hpp"

namespace septet::elastic {
namespace {

using Vectors = std::vector<Eigen::Vector3d>;

/// The velocities that the step solved for; those of before where it found no number.
Vectors solved_velocity_mps(const ElasticBody& before, const ElasticBody& after) {
  Vectors result = before.velocity_mps;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Eigen::Vector3d v = after.workspace.solution[i].head<3>().matrix();
    if (v.allFinite()) result[i] = v;
  }
  return result;
}

/// Impulses of the elements on the nodes at the solved velocities: what the step's system says beside inertia, weight
/// and forces.
Vectors inner_impulse_ns(ElasticBody& before, const StepSettings& settings, const Vectors& solved_mps) {
  StepReport report;
  assemble(before, settings, false, report);
  StepWorkspace& w = before.workspace;
  BlockVector velocity, image(solved_mps.size());
  velocity.reserve(solved_mps.size());
  for (const Eigen::Vector3d& v : solved_mps) velocity.push_back(padded(v));
  multiply(before.pattern, w.matrix, velocity, image);
  Vectors result(solved_mps.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double m = before.mass_kg[i];
    const Eigen::Vector3d known_ns =
        m * before.velocity_mps[i] + settings.step_s * (before.force_n[i] + m * settings.gravity_mps2);
    result[i] = (w.right_side[i] - image[i]).head<3>().matrix() - (known_ns - m * solved_mps[i]);
  }
  return result;
}

/// What stretches and shears of the elements store, and what β takes of their rate.
struct Strained {
  double stored_j = 0.0, viscous_j = 0.0;
};

/// The same of a sheet: its strains are forms of places as well.
void add_shell_strains(const ElasticBody& before, const ElasticBody& after, const StepSettings& settings,
                       const Vectors& solved_mps, const Vectors& mean_mps, Strained& sum) {
  const double beta_s = settings.damping_ratio * settings.step_s;
  sum.stored_j += shell_energy_j(after) - shell_energy_j(before);
  for_each_sample(before, before.position_m, [&](const ShellCell& cell, const auto& sample) {
    const auto rate_of = [&](const Vectors& velocity_mps) {
      return (sample.jacobian.transpose() * places_of(cell, velocity_mps).reshaped()).eval();
    };
    sum.viscous_j += settings.step_s * beta_s * rate_of(solved_mps).dot(sample.stiffness_j * rate_of(mean_mps));
  });
}

/// The mean stress of the step's two ends times the change of strain is the change of St. Venant–Kirchhoff's energy.
Strained strained(const ElasticBody& before, const ElasticBody& after, const StepSettings& settings,
                  const Vectors& solved_mps, const Vectors& mean_mps) {
  const LameConstants lame = lame_constants(before.material);
  const double beta_s = settings.damping_ratio * settings.step_s, volume_pa = lame.lambda_pa + 2.0 * lame.mu_pa;
  Strained sum;
  if (!before.shell.empty()) add_shell_strains(before, after, settings, solved_mps, mean_mps, sum);
  const double stretch = before.shell.empty() ? 1.0 : 0.0;  // Elements of a sheet have their guard alone.
  for (const Element& e : before.elements) {
    const Eigen::Matrix3d f = deformation_gradient(e, before.position_m), g = deformation_gradient(e, after.position_m);
    const Eigen::Matrix3d first = green_strain(f), last = green_strain(g);
    const double mean_work_pa = second_piola_stress(0.5 * (first + last), lame).cwiseProduct(last - first).sum();
    const double flat = std::max(0.0, least_determinant - f.determinant()),
                 flat_after = std::max(0.0, least_determinant - g.determinant());
    sum.stored_j +=
        e.rest_volume_m3 * (stretch * mean_work_pa + 0.5 * volume_pa * (flat_after + flat) * (flat_after - flat));
    const auto rate_of = [&](const Vectors& velocity_mps) -> Eigen::Matrix3d {
      const Eigen::Matrix3d half = 0.5 * f.transpose() * deformation_gradient(e, velocity_mps);
      return half + half.transpose();
    };
    const Eigen::Matrix3d stress_pa = beta_s * second_piola_stress(rate_of(solved_mps), lame);
    sum.viscous_j += stretch * settings.step_s * e.rest_volume_m3 * stress_pa.cwiseProduct(rate_of(mean_mps)).sum();
  }
  return sum;
}

}  // namespace

StepEnergy step_energy(ElasticBody before, const ElasticBody& after, const StepSettings& settings,
                       std::span<const NodeContact> contacts, double share) {
  const double dt = settings.step_s;
  const Vectors solved_mps = solved_velocity_mps(before, after);
  Vectors mean_mps = before.velocity_mps;
  for (std::size_t i = 0; i < mean_mps.size(); ++i) mean_mps[i] = 0.5 * (mean_mps[i] + after.velocity_mps[i]);
  Vectors inner_ns = inner_impulse_ns(before, settings, solved_mps);
  add_held_impulses(before, after, dt, inner_ns);
  const std::optional<Pivot> pivot = settings.follow_spin ? pivot_of(before) : std::nullopt;
  const RigidMotion motion = pivot ? motion_about(before, *pivot) : RigidMotion{};

  StepEnergy energy;
  double inner_work_j = 0.0;  // Of the elements and of the turn along arcs.
  for (int i = 0; i < before.node_count(); ++i) {
    const double m = before.mass_kg[i];
    const Eigen::Vector3d &mean = mean_mps[i], &force_n = before.force_n[i];
    const Eigen::Vector3d way_m = after.position_m[i] - before.position_m[i];
    Eigen::Vector3d impulse_ns = share * inner_ns[i];
    if (pivot) impulse_ns += share * dt * m * centrifugal_mps2(motion, before.position_m[i]);
    if (before.fixed[i]) {
      energy.surface_work_j -= (impulse_ns + share * dt * (force_n + m * settings.gravity_mps2)).dot(mean);
    } else {
      // The arcs turn what was solved for.
      const Eigen::Vector3d gained_mps = after.velocity_mps[i] - before.velocity_mps[i];
      impulse_ns += m * (gained_mps - share * (solved_mps[i] - before.velocity_mps[i]));
    }
    inner_work_j += impulse_ns.dot(mean);
    energy.force_work_j += force_n.dot(way_m);
    energy.numerical_loss_j += (force_n + m * settings.gravity_mps2).dot(way_m - share * dt * mean);
  }
  for (const NodeContact& c : contacts) {
    const Eigen::Vector3d slip_mps = mean_mps[c.node] - c.surface_velocity_mps;
    const double pressing_mps = slip_mps.dot(c.normal), pressed_ns = c.impulse_ns.dot(c.normal);
    energy.surface_work_j += c.impulse_ns.dot(c.surface_velocity_mps);
    energy.pressing_loss_j -= pressed_ns * pressing_mps;
    energy.friction_loss_j -= c.impulse_ns.dot(slip_mps) - pressed_ns * pressing_mps;
  }
  const Strained strain = strained(before, after, settings, solved_mps, mean_mps);
  energy.viscous_loss_j = share * strain.viscous_j;
  energy.numerical_loss_j -= inner_work_j + strain.stored_j + energy.viscous_loss_j;
  return energy;
}

}  // namespace septet::elastic
