#include "engine/effects/debris/energy_bound.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {
namespace {

/// Below this energy nothing is bounded.
constexpr double least_j = 1e-6;

/// Kinetic energy in a frame that moves with `frame_mps`.
double kinetic_energy_j(const Piece& piece, const Eigen::Vector3d& frame_mps) {
  double sum = 0.0;
  for (int i = 0; i < piece.body.node_count(); ++i)
    sum += 0.5 * piece.body.mass_kg[i] * (piece.body.velocity_mps[i] - frame_mps).squaredNorm();
  return sum;
}

/// Energy that the air can give a piece in a step; what it takes is no bound.
double air_work_j(const Piece& piece, const Eigen::Vector3d& frame_mps, double step_s) {
  double sum = 0.0;
  for (int i = 0; i < piece.body.node_count(); ++i) {
    const Eigen::Vector3d& force = piece.body.force_n[i];
    const Eigen::Vector3d gained_mps = step_s / piece.body.mass_kg[i] * force;
    sum += step_s * force.dot(piece.body.velocity_mps[i] - frame_mps + 0.5 * gained_mps);
  }
  return std::max(0.0, sum);
}

/// Relaxes the shape until it stores `most_j`, or as little as a few steps reach: what the elements' plastic strains,
/// which need not fit together, keep for good. A step without velocity, weight and contacts, long beside all periods of
/// the piece, is one of Newton's towards equilibrium; inner forces alone move the nodes, so that the mass centre stays
/// and the body does not turn.
void relax_shape(elastic::ElasticBody& body, double most_j) {
  constexpr int most_steps = 8, most_halvings = 20;
  elastic::ElasticBody relaxed = body;
  std::ranges::fill(relaxed.force_n, Eigen::Vector3d::Zero());
  elastic::StepSettings settings;
  settings.step_s = 0.1;
  settings.damping_ratio = 0.5;
  settings.gravity_mps2.setZero();
  settings.solver = elastic::Solver::direct;
  for (int k = 0; k < most_steps && elastic::elastic_energy_j(body) > most_j; ++k) {
    std::ranges::fill(relaxed.velocity_mps, Eigen::Vector3d::Zero());
    elastic::step_elastic(relaxed, settings);
    const double before_j = elastic::elastic_energy_j(body);
    const auto start_m = body.position_m;
    // The share of the step that leaves `most_j`, or else the first halving that stores less than before.
    double share = 1.0, least_share = 0.0;
    const auto take = [&](double part) {
      for (int i = 0; i < body.node_count(); ++i)
        body.position_m[i] = start_m[i] + part * (relaxed.position_m[i] - start_m[i]);
      return elastic::elastic_energy_j(body);
    };
    for (int halving = 0; halving < most_halvings; ++halving, share *= 0.5)
      if (take(share) < before_j) break;
    if (elastic::elastic_energy_j(body) < most_j)
      for (int halving = 0; halving < most_halvings; ++halving) {
        const double middle = 0.5 * (least_share + share);
        (take(middle) > most_j ? least_share : share) = middle;
      }
    if (!(take(share) < before_j)) {
      body.position_m = start_m;
      return;
    }
    relaxed.position_m = body.position_m;
  }
}

}  // namespace

Frame frame_of(const Piece& piece, std::span<const FoundContact> found, double step_s) {
  Frame frame;
  Eigen::AlignedBox3d velocities;
  for (const FoundContact& f : found)
    if (f.box >= 0) velocities.extend(f.contact.surface_velocity_mps);
  if (!velocities.isEmpty()) frame.velocity_mps = velocities.center();
  const double mass = elastic::total_mass_kg(piece.body);
  const double before = kinetic_energy_j(piece, frame.velocity_mps) + elastic::elastic_energy_j(piece.body);
  double apart = 0.0;
  for (const FoundContact& f : found)
    apart = std::max(apart, (f.contact.surface_velocity_mps - frame.velocity_mps).norm());
  // Extra energy of weight and of leaving a surface's inside.
  const double speed = std::sqrt(2.0 * before / mass), weight_j = mass * gravity_mps2 * step_s * (speed + 0.2);
  frame.allowed_j =
      weight_j + air_work_j(piece, frame.velocity_mps, step_s) + std::max(before, 0.5 * mass * apart * apart);
  return frame;
}

void bound_energy(Piece& piece, const Frame& frame) {
  auto& body = piece.body;
  const auto motion = elastic::rigid_motion(body);
  const double elastic_j = elastic::elastic_energy_j(body);
  const double mass = elastic::total_mass_kg(body);
  const double turning_j = 0.5 * motion.angular_momentum_nms.dot(motion.angular_velocity_radps);
  const double moving_j =
      std::max(0.0, elastic::kinetic_energy_j(body) - 0.5 * mass * motion.velocity_mps.squaredNorm() - turning_j);
  const double rigid_j = 0.5 * mass * (motion.velocity_mps - frame.velocity_mps).squaredNorm() + turning_j;
  const double budget_j = std::max(0.0, frame.allowed_j - rigid_j);
  if (elastic_j + moving_j <= std::max(budget_j, least_j)) return;
  // The velocity of the deformation gives first: what a step adds is mostly that.
  const double keep = moving_j > 0.0 ? std::sqrt(std::max(0.0, budget_j - elastic_j) / moving_j) : 0.0;
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d arm = body.position_m[i] - motion.centre_m;
    const Eigen::Vector3d rigid = motion.velocity_mps + motion.angular_velocity_radps.cross(arm);
    body.velocity_mps[i] = rigid + keep * (body.velocity_mps[i] - rigid);
  }
  if (elastic_j > budget_j) relax_shape(body, budget_j);
  const auto now = elastic::rigid_motion(body);
  const Eigen::Vector3d change = now.inertia_kgm2.inverse() * (motion.angular_momentum_nms - now.angular_momentum_nms);
  for (int i = 0; i < body.node_count(); ++i) body.velocity_mps[i] += change.cross(body.position_m[i] - now.centre_m);
}

void take_from_deformation(std::vector<Piece>& pieces, double energy_j) {
  if (!(energy_j > 0.0)) return;
  std::vector<Frame> frames;  // Allowed: at first what a piece has as a rigid body.
  std::vector<double> has_j;
  frames.reserve(pieces.size()), has_j.reserve(pieces.size());
  double sum_j = 0.0;
  for (const Piece& piece : pieces) {
    const auto motion = elastic::rigid_motion(piece.body);
    const double rigid_j = 0.5 * motion.angular_momentum_nms.dot(motion.angular_velocity_radps);
    frames.push_back({motion.velocity_mps, rigid_j});
    has_j.push_back(std::max(0.0, kinetic_energy_j(piece, motion.velocity_mps) - rigid_j) +
                    elastic::elastic_energy_j(piece.body));
    sum_j += has_j.back();
  }
  if (!(sum_j > 0.0)) return;
  const double kept = std::max(0.0, 1.0 - energy_j / sum_j);
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    frames[k].allowed_j += kept * has_j[k];
    bound_energy(pieces[k], frames[k]);
  }
}

double bound_blow(Piece& piece, const Frame& frame, double step_s, std::span<const Eigen::Vector3d> position_m,
                  std::span<const Eigen::Vector3d> velocity_mps, std::vector<elastic::NodeContact>& contacts) {
  auto& body = piece.body;
  if (kinetic_energy_j(piece, frame.velocity_mps) <= frame.allowed_j) return 1.0;
  // K(s) = K₀ + bs + as² of v₀ + s Δv.
  double a = 0.0, b = 0.0, k0 = 0.0;
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d change = body.velocity_mps[i] - velocity_mps[i], start = velocity_mps[i] - frame.velocity_mps;
    a += 0.5 * body.mass_kg[i] * change.squaredNorm();
    b += body.mass_kg[i] * start.dot(change);
    k0 += 0.5 * body.mass_kg[i] * start.squaredNorm();
  }
  const double root = std::sqrt(std::max(0.0, b * b + 4.0 * a * (frame.allowed_j - k0)));
  const double share = a > 0.0 ? std::clamp((root - b) / (2.0 * a), 0.0, 1.0) : 1.0;
  for (int i = 0; i < body.node_count(); ++i) {
    body.velocity_mps[i] = velocity_mps[i] + share * (body.velocity_mps[i] - velocity_mps[i]);
    body.position_m[i] = position_m[i] + step_s * body.velocity_mps[i];
  }
  for (auto& contact : contacts) contact.impulse_ns *= share;
  return share;
}

double lost_j(const Piece& piece, const Frame& frame) {
  return std::max(
      0.0, frame.allowed_j - kinetic_energy_j(piece, frame.velocity_mps) - elastic::elastic_energy_j(piece.body));
}

}  // namespace septet::debris
