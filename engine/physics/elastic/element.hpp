#pragma once
/// One tetrahedron: strain, stress, forces on its nodes and its stiffness blocks.
///
/// Green strain E = ½(FᵀF − I), St. Venant–Kirchhoff stress S = λ tr(E) I + 2μE (second Piola–Kirchhoff). With shape
/// gradients g_a and h_a = F g_a the force on node a is −V F S g_a, and Jᵀ D J, the stiffness without its geometric
/// part, has the blocks
///     K_ab = V [λ h_a h_bᵀ + μ h_b h_aᵀ + μ (g_a·g_b) F Fᵀ].
/// D is the tensor for shear strains ε₁₂ counted twice: Servin et al. print μ for 4μ (eq. 14), which makes shear four
/// times too soft.

#include <array>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/physics/elastic/block_matrix.hpp"
#include "engine/physics/elastic/elastic_body.hpp"

namespace septet::elastic {

inline std::array<Eigen::Vector3d, 4> shape_gradients(const Element& e) {
  const auto& b = e.rest_inverse;
  return {-(b.row(0) + b.row(1) + b.row(2)).transpose(), b.row(0).transpose(), b.row(1).transpose(),
          b.row(2).transpose()};
}

inline Eigen::Matrix3d deformation_gradient(const Element& e, const std::vector<Eigen::Vector3d>& x) {
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

/// Adds value(a, b) to the block of every pair of the element's nodes.
template <class Value>
void for_each_block(const Element& e, BlockMatrix& matrix, const Value& value) {
  const auto add = [&](Block& block, int a, int b) {
    const Eigen::Matrix3d k = value(a, b);
    for (int c = 0; c < 3; ++c) block.column[c] += padded(k.col(c));
  };
  for (int a = 0; a < 4; ++a) add(matrix.diagonal[e.nodes[a]], a, a);
  std::size_t slot = 0;
  for (int a = 1; a < 4; ++a)
    for (int b = 0; b < a; ++b) add(matrix.lower[e.slots[slot++]], a, b);
}

/// Adds scale·V·(λ h_a h_bᵀ + μ h_b h_aᵀ + μ (g_a·g_b) F Fᵀ) to the matrix, for all node pairs of
/// the element. The stepper does the same for four elements at a time (assembly.cpp).
inline void add_stiffness(const Element& e, const Eigen::Matrix3d& f, const LameConstants& m, double scale,
                          BlockMatrix& matrix) {
  const auto g = shape_gradients(e);
  const double v = scale * e.rest_volume_m3;
  const Eigen::Matrix3d fft = f * f.transpose();
  for_each_block(e, matrix, [&](int a, int b) -> Eigen::Matrix3d {
    const Eigen::Vector3d ha = f * g[a], hb = f * g[b];
    return v * (m.lambda_pa * ha * hb.transpose() + m.mu_pa * hb * ha.transpose() + m.mu_pa * g[a].dot(g[b]) * fft);
  });
}

/// Adds stiffness·V·c_a c_bᵀ, the stiffness of the determinant, with c_a = cof(F) g_a.
inline void add_volume_stiffness(const Element& e, const Eigen::Matrix3d& f, double stiffness_pa, BlockMatrix& matrix) {
  const auto g = shape_gradients(e);
  const Eigen::Matrix3d cof = cofactor(f);
  for_each_block(e, matrix, [&](int a, int b) -> Eigen::Matrix3d {
    return stiffness_pa * e.rest_volume_m3 * (cof * g[a]) * (cof * g[b]).transpose();
  });
}

/// The deviator of a stress or strain.
inline Eigen::Matrix3d without_pressure(const Eigen::Matrix3d& m) {
  return m - m.trace() / 3.0 * Eigen::Matrix3d::Identity();
}

}  // namespace septet::elastic
