#include "engine/physics/elastic/body_measures.hpp"

#include <algorithm>

#include <Eigen/Geometry>

#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/held_volume.hpp"

namespace septet::elastic {

double total_mass_kg(const ElasticBody& body) {
  double mass = 0.0;
  for (const double m : body.mass_kg) mass += m;
  return mass;
}

double kinetic_energy_j(const ElasticBody& body) {
  double energy = 0.0;
  for (int i = 0; i < body.node_count(); ++i) energy += 0.5 * body.mass_kg[i] * body.velocity_mps[i].squaredNorm();
  return energy;
}

double elastic_energy_j(const ElasticBody& body) {
  const LameConstants lame = lame_constants(body.material);
  const double stretch = body.shell.empty() ? 1.0 : 0.0;  // Elements of a sheet have their guard alone.
  double energy = shell_energy_j(body);
  for (const Element& e : body.elements) {
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m);
    const double missing = std::max(0.0, least_determinant - f.determinant());
    energy += e.rest_volume_m3 * (stretch * energy_density(green_strain(f), lame) +
                                  0.5 * (lame.lambda_pa + 2 * lame.mu_pa) * missing * missing);
  }
  return energy;
}

Eigen::Vector3d centre_of_mass_m(const ElasticBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) sum += body.mass_kg[i] * body.position_m[i];
  return sum / total_mass_kg(body);
}

Eigen::Vector3d momentum_ns(const ElasticBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) sum += body.mass_kg[i] * body.velocity_mps[i];
  return sum;
}

Eigen::Vector3d angular_momentum_nms(const ElasticBody& body) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) sum += body.mass_kg[i] * body.position_m[i].cross(body.velocity_mps[i]);
  return sum;
}

RigidMotion motion_about(const ElasticBody& body, const Eigen::Vector3d& centre_m,
                         const Eigen::Vector3d& velocity_mps) {
  RigidMotion motion;
  motion.centre_m = centre_m;
  motion.velocity_mps = velocity_mps;
  motion.angular_momentum_nms.setZero();
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d arm = body.position_m[i] - motion.centre_m;
    second_moment += body.mass_kg[i] * arm * arm.transpose();
    motion.angular_momentum_nms += body.mass_kg[i] * arm.cross(body.velocity_mps[i] - motion.velocity_mps);
  }
  motion.inertia_kgm2 = second_moment.trace() * Eigen::Matrix3d::Identity() - second_moment;
  motion.angular_velocity_radps = motion.inertia_kgm2.inverse() * motion.angular_momentum_nms;
  return motion;
}

RigidMotion rigid_motion(const ElasticBody& body) {
  return motion_about(body, centre_of_mass_m(body), momentum_ns(body) / total_mass_kg(body));
}

Eigen::Matrix3d cauchy_stress_pa(const ElasticBody& body, int element) {
  if (!body.shell.empty()) return shell_stress_pa(body, element);
  const Eigen::Matrix3d f = deformation_gradient(body.elements[element], body.position_m);
  const Eigen::Matrix3d s = stress_at_pa(body, element, green_strain(f));
  return f * s * f.transpose() / std::max(f.determinant(), least_determinant);
}

}  // namespace septet::elastic
