#include "engine/physics/elastic/step.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "engine/core/check.hpp"
#include "engine/physics/elastic/assembly.hpp"
#include "engine/physics/elastic/bad_nodes.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/director_arcs.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/held_volume.hpp"
#include "engine/physics/elastic/pivot.hpp"
#include "engine/physics/elastic/preconditioned_solve.hpp"

namespace septet::elastic {
namespace {

// The law of contact is derived in engine/effects/debris/contacts.cpp, with the meaning of these. All are chosen; the
// figures are of six parts of three seeds each that fall from a metre at 4 m/s onto a level road, for ten seconds.

/// κ, contact stiffness in units of node mass / Δt²: a column of a hundred nodes stands 0.2 mm deep at 15 ms. Nodes came
/// 59, 17 and 5 mm deep at 10, 100 and 1000; from 10⁴ on about twice as many steps are solved again, and 7 of some 110
/// pieces are still awake instead of 2.
constexpr double contact_stiffness = 1e3;
/// s₀: below this sliding speed friction is viscous, so that a resting body comes to rest. Ways and depths at rest are
/// the same from 0.2 to 20 mm/s.
constexpr double creep_speed_mps = 2e-3;
/// Solutions of a step; a contact that still pulls after them pulls until the next step. 13 % of the contacts pull after
/// one, 2.4 % after two, 0.8 % after four, none after eight, which solve a third more often again.
constexpr int most_contact_passes = 4;
/// Solutions of a step for the stress that keeps the volume of an incompressible solid; five to nine are enough.
constexpr int most_volume_passes = 20;
/// A spawn inside a wall is no shot. The figures are the same from 1 to 20 m/s.
constexpr double most_release_mps = 2.0;

void add_centrifugal_force(ElasticBody& body, const RigidMotion& motion, double dt) {
  for (int i = 0; i < body.node_count(); ++i)
    body.workspace.right_side[i] += padded(dt * body.mass_kg[i] * centrifugal_mps2(motion, body.position_m[i]));
}

/// Angular momentum about the pivot after the forces and contacts of this step.
Eigen::Vector3d expected_angular_momentum(const ElasticBody& body, const RigidMotion& before,
                                          const StepSettings& settings, std::span<const NodeContact> contacts) {
  Eigen::Vector3d result = before.angular_momentum_nms;
  for (int i = 0; i < body.node_count(); ++i)
    result += settings.step_s *
              (body.position_m[i] - before.centre_m).cross(body.force_n[i] + body.mass_kg[i] * settings.gravity_mps2);
  for (const NodeContact& c : contacts) result += (body.position_m[c.node] - before.centre_m).cross(c.impulse_ns);
  return result;
}

/// Moves the body along the arcs of its rigid rotation: positions and velocities turn by exp(Δt ω), and ω then changes
/// to follow the angular momentum, as a rigid body's does.
void move_along_arcs(ElasticBody& body, const Pivot& pivot, double dt, const Eigen::Vector3d& angular_momentum_nms) {
  RigidMotion motion = motion_about(body, pivot);
  const Eigen::Vector3d spin = motion.angular_velocity_radps;
  const double angle = spin.norm() * dt;
  const Eigen::Matrix3d turn =
      angle > 0 ? Eigen::AngleAxisd(angle, spin.normalized()).toRotationMatrix() : Eigen::Matrix3d::Identity().eval();
  const Eigen::Vector3d centre = motion.centre_m + dt * motion.velocity_mps;
  std::vector<Eigen::Vector3d> way_m(body.position_m.size());  // Of deforming, seen from what turns.
  for (int i = 0; i < body.node_count(); ++i)
    way_m[i] = dt * (body.velocity_mps[i] - motion.velocity_mps - spin.cross(body.position_m[i] - motion.centre_m));
  turn_directors(body, way_m, body.velocity_mps);
  for (int i = 0; i < body.node_count(); ++i) {
    if (body.fixed[i]) {
      body.position_m[i] += dt * body.velocity_mps[i];
      continue;
    }
    body.position_m[i] = centre + turn * (body.position_m[i] - motion.centre_m + way_m[i]);
    body.velocity_mps[i] = motion.velocity_mps + turn * (body.velocity_mps[i] - motion.velocity_mps);
  }
  motion = motion_about(body, pivot);
  const Eigen::Vector3d change =
      spin_of(pivot, motion.inertia_kgm2, angular_momentum_nms - motion.angular_momentum_nms);
  for (int i = 0; i < body.node_count(); ++i)
    if (!body.fixed[i]) body.velocity_mps[i] += change.cross(body.position_m[i] - motion.centre_m);
}

/// Moves a body that cannot turn as a whole; the directors of a sheet turn all the same.
void move_along_lines(ElasticBody& body, double dt) {
  std::vector<Eigen::Vector3d> way_m = body.velocity_mps;
  for (Eigen::Vector3d& way : way_m) way *= dt;
  turn_directors(body, way_m, body.velocity_mps);
  for (int i = 0; i < body.node_count(); ++i) body.position_m[i] += way_m[i];
}

/// A contact in the same regularised form as the strain: φ is the gap, its stiffness is large, and it acts while the
/// gap would close. Friction is a viscous block whose strength is Coulomb's at the present sliding speed, so that it
/// never reverses the motion.
struct ActiveContact {
  NodeContact* contact;
  double normal_rate_kg, normal_impulse_ns, tangent_rate_kg;

  /// Along the normal, at the node's new velocity.
  double normal_impulse_at(const Eigen::Vector3d& velocity_mps) const {
    return normal_impulse_ns - normal_rate_kg * (velocity_mps - contact->surface_velocity_mps).dot(contact->normal);
  }
};

/// Adds the contact to the system, or with −1 takes it out again.
void add_contact(const ActiveContact& a, double sign, StepWorkspace& w) {
  const NodeContact& c = *a.contact;
  const Eigen::Matrix3d normal_part = c.normal * c.normal.transpose();
  const Eigen::Matrix3d rate =
      sign * (a.normal_rate_kg * normal_part + a.tangent_rate_kg * (Eigen::Matrix3d::Identity() - normal_part));
  for (int k = 0; k < 3; ++k) w.matrix.diagonal[c.node].column[k] += padded(rate.col(k));
  w.right_side[c.node] += padded(rate * c.surface_velocity_mps + sign * a.normal_impulse_ns * c.normal);
}

/// Takes out the contacts that would pull; false where there is none. The gap of such a one opens within the step, and
/// opens further without it: what is left presses, as Signorini's condition asks.
bool release_pulling(const BlockVector& velocity_mps, std::vector<ActiveContact>& active, StepWorkspace& w) {
  return std::erase_if(active, [&](const ActiveContact& a) {
           if (!(a.normal_impulse_at(velocity_mps[a.contact->node].head<3>().matrix()) < 0.0)) return false;
           add_contact(a, -1.0, w);
           return true;
         }) > 0;
}

std::vector<ActiveContact> add_contacts(ElasticBody& body, const StepSettings& settings,
                                        std::span<NodeContact> contacts) {
  std::vector<ActiveContact> active;
  StepWorkspace& w = body.workspace;
  const double dt = settings.step_s, gamma = gamma_of(settings);
  std::vector<double> known_impulse;
  known_impulse.swap(body.contact_impulse_ns);
  body.contact_impulse_ns.assign(known_impulse.size(), 0.0);
  for (NodeContact& c : contacts) {
    SEPTET_CHECK(c.node >= 0 && c.node < body.node_count(), "contact of node {}", c.node);
    c.impulse_ns.setZero();
    if (body.fixed[c.node]) continue;
    const double m = body.mass_kg[c.node];
    const Eigen::Vector3d relative = body.velocity_mps[c.node] - c.surface_velocity_mps;
    const double normal_speed = relative.dot(c.normal);
    const Eigen::Vector3d predicted = relative + dt * settings.gravity_mps2;
    if (c.gap_m + dt * predicted.dot(c.normal) > 0.0) continue;
    const double gap = std::max(c.gap_m, -most_release_mps * dt / gamma);
    ActiveContact a{&c, 0, 0, 0};
    a.normal_rate_kg = contact_stiffness * m / gamma;
    a.normal_impulse_ns = -contact_stiffness * m * gap / dt;
    const Eigen::Vector3d slide = relative - normal_speed * c.normal;
    const double pressing = std::max(known_impulse[c.node], m * std::max(0.0, -predicted.dot(c.normal)));
    a.tangent_rate_kg = c.friction * pressing / std::max(slide.norm(), creep_speed_mps);
    add_contact(a, 1.0, w);
    active.push_back(a);
  }
  return active;
}

/// Replaces the rows of fixed nodes by "keeps its velocity" and moves their columns to the right-hand side.
void hold_fixed_nodes(ElasticBody& body) {
  StepWorkspace& w = body.workspace;
  if (std::ranges::find(body.fixed, std::uint8_t{1}) == body.fixed.end()) return;
  for (int i = 0; i < body.node_count(); ++i)
    for (int s = body.pattern.row_start[i]; s < body.pattern.row_start[i + 1]; ++s) {
      const int j = body.pattern.column[s];
      if (!body.fixed[i] && !body.fixed[j]) continue;
      Block& block = w.matrix.lower[s];
      const Eigen::Vector3d& vi = body.velocity_mps[i];
      const Eigen::Vector3d& vj = body.velocity_mps[j];
      if (!body.fixed[i])
        w.right_side[i] -= block.column[0] * vj[0] + block.column[1] * vj[1] + block.column[2] * vj[2];
      if (!body.fixed[j])
        for (int c = 0; c < 3; ++c) w.right_side[j][c] -= (block.column[c] * padded(vi)).sum();
      block = zero_block();
    }
  for (int i = 0; i < body.node_count(); ++i) {
    if (!body.fixed[i]) continue;
    w.matrix.diagonal[i] = zero_block();
    for (int c = 0; c < 3; ++c) w.matrix.diagonal[i].column[c][c] = body.mass_kg[i];
    w.right_side[i] = padded(body.mass_kg[i] * body.velocity_mps[i]);
  }
}

/// The first guess of the conjugate gradients: every node flies.
void start_from_flight(ElasticBody& body, const StepSettings& settings) {
  StepWorkspace& w = body.workspace;
  w.solution.resize(body.velocity_mps.size());
  const Eigen::Vector3d gained_mps = settings.step_s * settings.gravity_mps2;
  for (int i = 0; i < body.node_count(); ++i)
    w.solution[i] = padded(body.fixed[i] ? body.velocity_mps[i] : body.velocity_mps[i] + gained_mps);
  follow_rotations(body);
}

/// The new velocities; not a number where the matrix has no factor.
void solve_system(ElasticBody& body, const StepSettings& settings, bool direct, StepReport& report) {
  StepWorkspace& w = body.workspace;
  if (direct && !factorise(body.pattern, body.factor_structure, w.matrix, w.factor)) {
    w.solution.assign(body.velocity_mps.size(), padded(Eigen::Vector3d::Constant(NAN)));
    return;
  }
  int pass = 0;
  do {
    if (direct) {
      w.solution = w.right_side;
      solve(body.factor_structure, w.factor, w.solution);
    } else {
      const SolveReport result = preconditioned_solve(body, settings);
      report.iterations += result.iterations;
      report.converged = result.converged;
    }
  } while (++pass <= most_volume_passes && hold_volume(body, settings));
}

/// The multiplier of eq. 20 as a stress: D (φ + Δt/γ J v⁺), the mean over the step.
void keep_step_stress(ElasticBody& body, const StepSettings& settings) {
  const double lead_s = settings.step_s / gamma_of(settings);
  body.step_stress_pa.clear();
  if (!body.shell.empty()) {
    for (int e = 0; e < static_cast<int>(body.elements.size()); ++e)
      body.step_stress_pa.push_back(shell_stress_pa(body, e, lead_s));
    return;
  }
  for (int k = 0; k < static_cast<int>(body.elements.size()); ++k) {
    const Element& e = body.elements[k];
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
    const Eigen::Matrix3d rate = f.transpose() * deformation_gradient(e, body.velocity_mps);
    const Eigen::Matrix3d strain = green_strain(f) + 0.5 * lead_s * (rate + rate.transpose());
    body.step_stress_pa.push_back(f * stress_at_pa(body, k, strain) * f.transpose() /
                                  std::max(f.determinant(), least_determinant));
  }
}

}  // namespace

StepReport step_elastic(ElasticBody& body, const StepSettings& settings, std::span<NodeContact> contacts) {
  SEPTET_CHECK(settings.step_s > 0 && settings.damping_ratio >= 0, "step {} s, damping {}", settings.step_s,
               settings.damping_ratio);
  StepReport report;
  report.bad_numbers = reset_bad_nodes(body);
  const bool direct =
      settings.solver == Solver::direct ||
      (settings.solver == Solver::automatic && static_cast<int>(body.elements.size()) <= settings.direct_limit);
  assemble(body, settings, !direct, report);
  const std::optional<Pivot> pivot = settings.follow_spin ? pivot_of(body) : std::nullopt;
  const RigidMotion before = pivot ? motion_about(body, *pivot) : RigidMotion{};
  if (pivot) add_centrifugal_force(body, before, settings.step_s);
  auto active = add_contacts(body, settings, contacts);
  hold_fixed_nodes(body);
  release_volume(body);

  StepWorkspace& w = body.workspace;
  if (!direct) start_from_flight(body, settings);
  solve_system(body, settings, direct, report);
  for (int pass = 1; pass < most_contact_passes && release_pulling(w.solution, active, w); ++pass)
    solve_system(body, settings, direct, report);
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d v = w.solution[i].head<3>().matrix();
    if (v.allFinite())
      body.velocity_mps[i] = v;
    else
      ++report.bad_numbers;  // The node keeps its velocity.
  }
  for (const ActiveContact& a : active) {
    const NodeContact& c = *a.contact;
    const Eigen::Vector3d relative = body.velocity_mps[c.node] - c.surface_velocity_mps;
    const double normal_speed = relative.dot(c.normal), normal_impulse = a.normal_impulse_at(body.velocity_mps[c.node]);
    a.contact->impulse_ns = normal_impulse * c.normal - a.tangent_rate_kg * (relative - normal_speed * c.normal);
    body.contact_impulse_ns[c.node] += std::max(0.0, normal_impulse);
  }
  if (settings.keep_stress) keep_step_stress(body, settings);
  if (pivot)
    move_along_arcs(body, *pivot, settings.step_s, expected_angular_momentum(body, before, settings, contacts));
  else
    move_along_lines(body, settings.step_s);
  report.bad_numbers += reset_bad_nodes(body);  // Other code reads the body from here on.
  return report;
}

}  // namespace septet::elastic
