#pragma once
/// What one tetrahedron does: strain, stress, forces on its nodes and its stiffness blocks.
///
/// Green strain E = ½(FᵀF − I), St. Venant–Kirchhoff stress S = λ tr(E) I + 2μE (second
/// Piola–Kirchhoff). With shape gradients g_a and h_a = F g_a the force on node a is −V F S g_a, and
/// Jᵀ D J, the stiffness without its geometric part, has the blocks
///     K_ab = V [λ h_a h_bᵀ + μ h_b h_aᵀ + μ (g_a·g_b) F Fᵀ].
/// D is the tensor for shear strains ε₁₂ counted twice: Servin et al. print μ for 4μ (eq. 14), which
/// makes shear four times too soft.

#include <array>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "engine/physics/elastic/block_matrix.hpp"
#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

inline std::array<Eigen::Vector3d, 4> shape_gradients(const Element& e) {
  const auto& b = e.rest_inverse;
  return {-(b.row(0) + b.row(1) + b.row(2)).transpose(), b.row(0).transpose(),
          b.row(1).transpose(), b.row(2).transpose()};
}

inline Eigen::Matrix3d deformation_gradient(const Element& e,
                                            const std::vector<Eigen::Vector3d>& x) {
  const Eigen::Vector3d& origin = x[e.nodes[0]];
  Eigen::Matrix3d edges;
  edges.col(0) = x[e.nodes[1]] - origin;
  edges.col(1) = x[e.nodes[2]] - origin;
  edges.col(2) = x[e.nodes[3]] - origin;
  return edges * e.rest_inverse;
}

inline Eigen::Matrix3d green_strain(const Eigen::Matrix3d& f) {
  return 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
}

inline Eigen::Matrix3d second_piola_stress(const Eigen::Matrix3d& strain, const LameConstants& m) {
  return m.lambda_pa * strain.trace() * Eigen::Matrix3d::Identity() + 2.0 * m.mu_pa * strain;
}

/// ½ S:E per volume of rest.
inline double energy_density(const Eigen::Matrix3d& strain, const LameConstants& m) {
  const double trace = strain.trace();
  return 0.5 * m.lambda_pa * trace * trace + m.mu_pa * strain.squaredNorm();
}

/// Green strain cannot tell a tetrahedron from its mirror image. The determinant is therefore a
/// second displacement, φ = det F − 0.3 where that is negative, with stiffness λ+2μ: stronger than
/// the pull of St. Venant–Kirchhoff towards the mirrored rest shape, at any depth.
inline constexpr double least_determinant = 0.3;

inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d c;
  c.col(0) = f.col(1).cross(f.col(2));
  c.col(1) = f.col(2).cross(f.col(0));
  c.col(2) = f.col(0).cross(f.col(1));
  return c;
}

/// Adds scale·V·(λ h_a h_bᵀ + μ h_b h_aᵀ + μ (g_a·g_b) F Fᵀ + κ c_a c_bᵀ + g_aᵀ T g_b I) to the
/// matrix, for all node pairs of the element. `volume_stiffness` κ and `tension` T may be zero.
inline void add_stiffness(const Element& e, const Eigen::Matrix3d& f, const LameConstants& m,
                          double scale, double volume_stiffness_pa, const Eigen::Matrix3d& tension,
                          bool with_tension, BlockMatrix& matrix) {
  const auto g = shape_gradients(e);
  const double v = scale * e.rest_volume_m3, lambda = v * m.lambda_pa, mu = v * m.mu_pa;
  const Eigen::Matrix3d fft = f * f.transpose();
  const Eigen::Array4d fft0 = padded(fft.col(0)), fft1 = padded(fft.col(1)),
                       fft2 = padded(fft.col(2));
  std::array<Eigen::Array4d, 4> h;
  for (int a = 0; a < 4; ++a) h[a] = padded(f * g[a]);
  const auto add = [&](Block& block, int a, int b) {
    const double shear = mu * g[a].dot(g[b]);
    const Eigen::Array4d la = lambda * h[a], mb = mu * h[b];
    block.column[0] += la * h[b][0] + mb * h[a][0] + shear * fft0;
    block.column[1] += la * h[b][1] + mb * h[a][1] + shear * fft1;
    block.column[2] += la * h[b][2] + mb * h[a][2] + shear * fft2;
  };
  for (int a = 0; a < 4; ++a) add(matrix.diagonal[e.nodes[a]], a, a);
  std::size_t slot = 0;
  for (int a = 1; a < 4; ++a)
    for (int b = 0; b < a; ++b) add(matrix.lower[e.slots[slot++]], a, b);
  if (volume_stiffness_pa == 0.0 && !with_tension) return;

  const Eigen::Matrix3d cof = cofactor(f);
  const auto add_rare = [&](Block& block, int a, int b) {
    const Eigen::Vector3d ca = cof * g[a], cb = cof * g[b];
    const double pull = with_tension ? v * g[a].dot(tension * g[b]) : 0.0;
    for (int c = 0; c < 3; ++c) {
      block.column[c] += padded(v * volume_stiffness_pa * cb[c] * ca);
      block.column[c][c] += pull;
    }
  };
  for (int a = 0; a < 4; ++a) add_rare(matrix.diagonal[e.nodes[a]], a, a);
  slot = 0;
  for (int a = 1; a < 4; ++a)
    for (int b = 0; b < a; ++b) add_rare(matrix.lower[e.slots[slot++]], a, b);
}

/// The part of a symmetric stress that pulls.
inline Eigen::Matrix3d tensile_part(const Eigen::Matrix3d& stress) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen;
  eigen.computeDirect(stress);
  return eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
         eigen.eigenvectors().transpose();
}

}  // namespace septet::elastic
