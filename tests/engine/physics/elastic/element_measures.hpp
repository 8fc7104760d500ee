#pragma once
/// Measures of a body over its elements that its step does not need as such.

#include <algorithm>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/element.hpp"

namespace septet::elastic {

/// The least share of its rest volume that an element has; negative where one is turned inside out.
inline double least_determinant_of(const ElasticBody& body) {
  double least = std::numeric_limits<double>::infinity();
  for (const Element& e : body.elements)
    least = std::min(least, deformation_gradient(e, body.position_m).determinant());
  return least;
}

inline double volume_m3(const ElasticBody& body) {
  double volume = 0.0;
  for (const Element& e : body.elements)
    volume += e.rest_volume_m3 * deformation_gradient(e, body.position_m).determinant();
  return volume;
}

/// Internal force on every node, −∂U/∂x.
inline std::vector<Eigen::Vector3d> internal_forces_n(const ElasticBody& body) {
  const LameConstants lame = lame_constants(body.material);
  std::vector<Eigen::Vector3d> force(body.position_m.size(), Eigen::Vector3d::Zero());
  for (const Element& e : body.elements) {
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
    const Eigen::Matrix3d s = second_piola_stress(green_strain(f), lame);
    Eigen::Matrix3d first_piola = f * s;
    const double determinant = f.determinant();
    if (determinant < least_determinant)
      first_piola += (lame.lambda_pa + 2 * lame.mu_pa) * (determinant - least_determinant) * cofactor(f);
    const Eigen::Matrix3d forces = -e.rest_volume_m3 * first_piola * e.rest_inverse.transpose();
    force[e.nodes[0]] -= forces.rowwise().sum();
    for (int a = 0; a < 3; ++a) force[e.nodes[a + 1]] += forces.col(a);
  }
  return force;
}

}  // namespace septet::elastic
