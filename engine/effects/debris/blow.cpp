#include "engine/effects/debris/blow.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "engine/physics/elastic/body_measures.hpp"

namespace septet::debris {

std::vector<double> add_restitution(const Piece& piece, std::vector<FoundContact>& contacts, double step_s) {
  std::vector<double> closing_mps;
  for (FoundContact& found : contacts) {
    auto& c = found.contact;
    const double closing = (c.surface_velocity_mps - piece.body.velocity_mps[c.node]).dot(c.normal);
    const bool meets = closing > least_blow_speed_mps && c.gap_m < closing * step_s;
    closing_mps.push_back(meets ? closing : 0.0);
    if (!meets) continue;
    c.surface_velocity_mps += piece.material.restitution * closing * c.normal;
    c.gap_m = std::min(c.gap_m, 0.0);  // It touches within the step: the impulse is due now.
  }
  return closing_mps;
}

Blow blow_of(const Piece& piece, std::span<const elastic::NodeContact> contacts, std::span<const double> closing_mps,
             double step_s) {
  Blow blow;
  const double e = piece.material.restitution;
  Eigen::Vector3d impulse = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const double pressed_ns = contacts[i].impulse_ns.dot(contacts[i].normal);
    if (closing_mps[i] <= 0.0 || pressed_ns <= 0.0) continue;
    impulse += pressed_ns * contacts[i].normal;
    // m V²/2 comes in, with J = (1 + e) m V.
    blow.lost_j += 0.5 * pressed_ns * closing_mps[i] / (1.0 + e) * (1.0 - e * e);
  }
  if (blow.lost_j <= 0.0) return blow;
  blow.normal = impulse.normalized();
  double low = INFINITY, high = -INFINITY;
  for (const auto& x : piece.body.position_m) {
    low = std::min(low, x.dot(blow.normal));
    high = std::max(high, x.dot(blow.normal));
  }
  double element_m = 0.0;
  for (const auto& element : piece.body.elements) {
    Eigen::Vector4d along;
    for (int a = 0; a < 4; ++a) along[a] = piece.body.position_m[element.nodes[a]].dot(blow.normal);
    element_m += (along.maxCoeff() - along.minCoeff()) / static_cast<double>(piece.body.elements.size());
  }
  // The step's stress falls to zero at the far side, and an element has its mean; the wave's does not fall.
  const double mean_share = 1.0 - 0.5 * std::min(1.0, element_m / (high - low));
  const auto& m = piece.material.elastic;
  const double wave_mps = std::sqrt(m.young_modulus_pa / m.density_kgpm3);
  blow.stress_factor = std::max(1.0, step_s * wave_mps / ((1.0 + e) * (high - low) * mean_share));
  return blow;
}

double scatter(std::vector<Piece>& fragments, const Eigen::Vector3d& normal, double energy_j) {
  if (fragments.size() < 2 || !(energy_j > 0.0)) return 0.0;
  double mass = 0.0;
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const Piece& p : fragments) {
    const double m = elastic::total_mass_kg(p.body);
    mass += m;
    centre += m * elastic::centre_of_mass_m(p.body);
  }
  centre /= mass;
  // Each fragment moves away from the middle as a whole; the rigid turn that this would give to all of them together is
  // subtracted.
  std::vector<Eigen::Vector3d> away;
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  for (const Piece& p : fragments) {
    const Eigen::Vector3d arm = elastic::centre_of_mass_m(p.body) - centre;
    away.push_back(arm - arm.dot(normal) * normal);
    spin += elastic::total_mass_kg(p.body) * arm.cross(away.back());
    for (int i = 0; i < p.body.node_count(); ++i) {
      const Eigen::Vector3d r = p.body.position_m[i] - centre;
      second_moment += p.body.mass_kg[i] * r * r.transpose();
    }
  }
  const Eigen::Matrix3d inertia = second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
  const Eigen::Vector3d turn = inertia.ldlt().solve(-spin);
  const auto field = [&](std::size_t k, int i) -> Eigen::Vector3d {
    return away[k] + turn.cross(fragments[k].body.position_m[i] - centre);
  };
  // ½ Σ m (v + s u)² − ½ Σ m v² = energy, solved for s ≥ 0.
  double linear = 0.0, square = 0.0;
  for (std::size_t k = 0; k < fragments.size(); ++k)
    for (int i = 0; i < fragments[k].body.node_count(); ++i) {
      const Eigen::Vector3d u = field(k, i);
      linear += fragments[k].body.mass_kg[i] * u.dot(fragments[k].body.velocity_mps[i]);
      square += 0.5 * fragments[k].body.mass_kg[i] * u.squaredNorm();
    }
  if (!(square > 0.0)) return 0.0;
  const double root = std::sqrt(linear * linear + 4.0 * square * energy_j);
  const double speed = linear > 0.0 ? 2.0 * energy_j / (root + linear) : (root - linear) / (2.0 * square);
  for (std::size_t k = 0; k < fragments.size(); ++k)
    for (int i = 0; i < fragments[k].body.node_count(); ++i) fragments[k].body.velocity_mps[i] += speed * field(k, i);
  return energy_j;
}

}  // namespace septet::debris
