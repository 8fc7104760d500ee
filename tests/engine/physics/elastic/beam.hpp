#pragma once
/// The beam of Servin et al. (0.1 × 0.1 × 2.1 m along z) under the loads of their figures 8 and 9, and the predictions
/// of Euler–Bernoulli and Saint-Venant. Shared by tests and figures.

#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "engine/core/check.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/engine/physics/elastic/equilibrium.hpp"
#include "tests/engine/physics/elastic/fixed_nodes.hpp"

namespace septet::elastic::beam {

inline constexpr double side_m = 0.1, length_m = 2.1;
inline constexpr double area_m2 = side_m * side_m;
/// Torsion constant of a square section and its second moment of area.
inline const double torsion_constant_m4 = 0.1406 * std::pow(side_m, 4);
inline const double bending_constant_m4 = std::pow(side_m, 4) / 12.0;

inline ElasticBody make(int cells_across, const ElasticMaterial& material = {1e8, 0.25, 1000.0}) {
  auto body = make_elastic_body(
      lattice_mesh({cells_across, cells_across, 21 * cells_across}, {side_m, side_m, length_m}), material);
  SEPTET_CHECK(body.has_value(), "{}", body.error().what);
  return std::move(*body);
}

inline bool at_start(const ElasticBody& b, int i) { return b.rest_position_m[i].z() < 1e-9; }
inline bool at_end(const ElasticBody& b, int i) { return b.rest_position_m[i].z() > length_m - 1e-9; }

inline void clamp_start(ElasticBody& body) { fix_nodes(body, {-1, -1, -1e-9}, {1, 1, 1e-9}); }

/// A uniform traction along z on the part of the surface whose nodes are all `on_face`.
template <class OnFace>
void load_face(ElasticBody& body, OnFace on_face, double traction_pa) {
  // Consistent loads: each face triangle gives a third of its force to each of its nodes.
  std::vector<Tetrahedron> tetrahedra;
  for (const auto& e : body.elements) tetrahedra.push_back(e.nodes);
  const auto& x = body.rest_position_m;
  for (const auto& face : surface_triangles(x, tetrahedra)) {
    const auto [a, b, c] = face.nodes;
    if (!on_face(body, a) || !on_face(body, b) || !on_face(body, c)) continue;
    const double area = 0.5 * (x[b] - x[a]).cross(x[c] - x[a]).norm();
    for (const int node : face.nodes) body.force_n[node].z() += traction_pa * area / 3.0;
  }
}

/// A uniform traction on both ends (free = true), or on the far end of a clamped beam.
inline void pull(ElasticBody& body, double force_n, bool free) {
  load_face(body, at_end, force_n / area_m2);
  if (free) load_face(body, at_start, -force_n / area_m2);
}

template <class OnFace>
double mean_z(const ElasticBody& body, OnFace on_face) {
  double sum = 0.0;
  int count = 0;
  for (int i = 0; i < body.node_count(); ++i)
    if (on_face(body, i)) sum += body.position_m[i].z(), ++count;
  return sum / count;
}

/// Strain of a beam along z under a static traction on both ends (free = true) or on the far end of a clamped one.
inline double static_stretch(ElasticBody& body, double traction_pa, bool free) {
  if (free) {
    // One fixed node holds the body's place; the tension itself keeps it from turning.
    int corner = 0;
    for (int i = 1; i < body.node_count(); ++i)
      if (body.rest_position_m[i].sum() < body.rest_position_m[corner].sum()) corner = i;
    body.fixed[corner] = 1;
    invalidate_rest_factor(body);
    load_face(body, at_start, -traction_pa);
  } else {
    clamp_start(body);
  }
  load_face(body, at_end, traction_pa);
  const auto report = find_equilibrium(body, Eigen::Vector3d::Zero());
  SEPTET_CHECK(report.converged, "no equilibrium at {} Pa", traction_pa);
  return (mean_z(body, at_end) - mean_z(body, at_start)) / length_m - 1.0;
}

inline double static_stretch(int cells_across, double force_over_ya, bool free, double poisson_ratio = 0.25,
                             double* volume_ratio = nullptr) {
  ElasticBody body = make(cells_across, {1e8, poisson_ratio, 1000.0});
  const double before = volume_m3(body), strain = static_stretch(body, force_over_ya * 1e8, free);
  if (volume_ratio) *volume_ratio = volume_m3(body) / before;
  return strain;
}

/// Strain of a block pushed by a static force. It is short, because the long beam would buckle at a fiftieth of this
/// load, and without lateral strain, so that the clamp has no effect.
inline double static_push_strain(int cells_across, double force_over_ya) {
  auto body = *make_elastic_body(
      lattice_mesh({cells_across, cells_across, 2 * cells_across}, {side_m, side_m, 2 * side_m}), {1e8, 0.0, 1000.0});
  clamp_start(body);
  const auto is_end = [](const ElasticBody& b, int i) { return b.rest_position_m[i].z() > 2 * side_m - 1e-9; };
  load_face(body, is_end, force_over_ya * 1e8);
  const auto report = find_equilibrium(body, Eigen::Vector3d::Zero());
  SEPTET_CHECK(report.converged, "no equilibrium at {}", force_over_ya);
  return mean_z(body, is_end) / (2 * side_m) - 1.0;
}

/// A clamped beam along z whose section has this middle and torsion constant: twist of its end by a small moment,
/// relative to θ = τL/(μK).
inline double static_twist_ratio(ElasticBody body, const Eigen::Vector2d& middle_m, double torsion_constant) {
  clamp_start(body);
  const double expected_rad = 1e-3;
  const double moment = expected_rad * lame_constants(body.material).mu_pa * torsion_constant / length_m;
  const Eigen::Vector3d centre(middle_m.x(), middle_m.y(), length_m);
  double inertia = 0.0;
  for (int i = 0; i < body.node_count(); ++i)
    if (at_end(body, i)) inertia += (body.rest_position_m[i] - centre).squaredNorm();
  for (int i = 0; i < body.node_count(); ++i)
    if (at_end(body, i))
      body.force_n[i] = moment / inertia * Eigen::Vector3d::UnitZ().cross(body.rest_position_m[i] - centre);
  const auto report = find_equilibrium(body, Eigen::Vector3d::Zero());
  SEPTET_CHECK(report.converged, "no equilibrium");
  double angle = 0.0;
  for (int i = 0; i < body.node_count(); ++i)
    if (at_end(body, i)) {
      const Eigen::Vector3d arm = body.rest_position_m[i] - centre;
      angle += Eigen::Vector3d::UnitZ().cross(arm).dot(body.position_m[i] - body.rest_position_m[i]) / inertia;
    }
  return angle / expected_rad;
}

inline double static_twist_ratio(int cells_across, double poisson_ratio = 0.25) {
  return static_twist_ratio(make(cells_across, {1e8, poisson_ratio, 1000.0}), {side_m / 2, side_m / 2},
                            torsion_constant_m4);
}

/// Deflection of the clamped beam's end under a small transverse force over that of Euler and
/// Bernoulli.
inline double static_bend_ratio(int cells_across, double poisson_ratio = 0.25) {
  ElasticBody body = make(cells_across, {1e8, poisson_ratio, 1000.0});
  clamp_start(body);
  const double expected_m = 1e-4;
  const double force = expected_m * 3 * 1e8 * bending_constant_m4 / (length_m * length_m * length_m);
  int count = 0;
  for (int i = 0; i < body.node_count(); ++i) count += at_end(body, i);
  for (int i = 0; i < body.node_count(); ++i)
    if (at_end(body, i)) body.force_n[i].x() = force / count;
  const auto report = find_equilibrium(body, Eigen::Vector3d::Zero());
  SEPTET_CHECK(report.converged, "no equilibrium");
  double deflection = 0.0;
  for (int i = 0; i < body.node_count(); ++i)
    if (at_end(body, i)) deflection += (body.position_m[i] - body.rest_position_m[i]).x() / count;
  return deflection / expected_m;
}

/// The stretch s at which St. Venant–Kirchhoff carries F/YA: s (s²−1)/2 = F/YA, near s = 1.
inline double st_venant_kirchhoff_strain(double force_over_ya) {
  double s = 1.0 + force_over_ya;
  for (int i = 0; i < 50; ++i) s -= (s * (s * s - 1) / 2 - force_over_ya) / ((3 * s * s - 1) / 2);
  return s - 1.0;
}

}  // namespace septet::elastic::beam
