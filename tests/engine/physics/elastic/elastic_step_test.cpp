#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <Eigen/Dense>

#include "engine/physics/elastic/element.hpp"
#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

ElasticBody block(const ElasticMaterial& material, Eigen::Vector3i cells = {2, 2, 2}) {
  return *make_elastic_body(lattice_mesh(cells, 0.1 * cells.cast<double>()), material);
}

/// A smooth deformation with shear, twist and stretch of a few per cent.
void deform(ElasticBody& body) {
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d x = body.rest_position_m[i];
    body.position_m[i] = x + Eigen::Vector3d(0.3 * x.y() * x.z() + 0.02 * x.x(), -0.2 * x.x() * x.z(),
                                             0.05 * x.x() - 0.4 * x.y() * x.y());
    body.velocity_mps[i] = {0.3 * x.y(), -0.2 + x.z(), 0.1 * x.x()};
  }
}

/// Eq. 20 as printed (with α⁻¹ = D of the correct shear): velocities from the saddle-point system.
Eigen::VectorXd dual_velocities(const ElasticBody& body, double dt, double gamma) {
  const int n = 3 * body.node_count(), m = 6 * static_cast<int>(body.elements.size());
  const LameConstants lame = lame_constants(body.material);
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(n + m, n + m);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + m);
  for (int i = 0; i < body.node_count(); ++i) {
    system.block<3, 3>(3 * i, 3 * i).diagonal().setConstant(body.mass_kg[i]);
    right.segment<3>(3 * i) = body.mass_kg[i] * body.velocity_mps[i];
  }
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(lame.lambda_pa);
  d.diagonal().head<3>().array() += 2 * lame.mu_pa;
  d.diagonal().tail<3>().setConstant(4 * lame.mu_pa);  // ε₁₂ appears twice in ε:ε.
  const std::array<std::pair<int, int>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
  for (std::size_t k = 0; k < body.elements.size(); ++k) {
    const Element& e = body.elements[k];
    const Eigen::Matrix3d f = deformation_gradient(e, body.position_m), strain = green_strain(f);
    const double root = std::sqrt(e.rest_volume_m3);
    const auto g = shape_gradients(e);
    const int row = n + 6 * static_cast<int>(k);
    for (int s = 0; s < 6; ++s) {
      const auto [p, q] = pairs[s];
      right[row + s] = -gamma / dt * root * strain(p, q);
      for (int a = 0; a < 4; ++a) {
        const Eigen::Vector3d j = 0.5 * root * (f.col(p) * g[a][q] + f.col(q) * g[a][p]);
        system.block<1, 3>(row + s, 3 * e.nodes[a]) = j.transpose();
        system.block<3, 1>(3 * e.nodes[a], row + s) = -j;
      }
    }
    system.block<6, 6>(row, row) = gamma / (dt * dt) * d.inverse();
  }
  return system.fullPivLu().solve(right).head(n);
}

}  // namespace

TEST_CASE("the primal form gives the velocities of the published dual form") {
  ElasticBody body = block({1e6, 0.3, 1000.0}, {1, 1, 2});
  deform(body);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  const Eigen::VectorXd expected = dual_velocities(body, settings.step_s, gamma_of(settings));
  for (const Solver solver : {Solver::direct, Solver::rest_factor}) {
    ElasticBody stepped = body;
    settings.solver = solver;
    settings.tension_stiffness = false;
    settings.follow_spin = false;
    settings.tolerance = 1e-12;
    step_elastic(stepped, settings);
    for (int i = 0; i < body.node_count(); ++i)
      CHECK((stepped.velocity_mps[i] - expected.segment<3>(3 * i)).norm() < 1e-7 * expected.norm());
  }
}

TEST_CASE("the force is minus the gradient of the energy, flattened and inverted elements included") {
  ElasticBody body = block({1e6, 0.3, 1000.0}, {1, 1, 1});
  for (const double squeeze : {0.0, 0.08, 0.25}) {
    deform(body);
    body.position_m[0] += Eigen::Vector3d(squeeze, squeeze, squeeze);
    const auto force = internal_forces_n(body);
    const double h = 1e-7;
    for (int i = 0; i < body.node_count(); ++i)
      for (int c = 0; c < 3; ++c) {
        ElasticBody moved = body;
        moved.position_m[i][c] += h;
        const double up = elastic_energy_j(moved);
        moved.position_m[i][c] -= 2 * h;
        const double slope = (up - elastic_energy_j(moved)) / (2 * h);
        CHECK(force[i][c] == doctest::Approx(-slope).epsilon(1e-4).scale(100.0));
      }
  }
}

TEST_CASE("a turned body steps as the unturned one turned") {
  ElasticBody body = block({1e8, 0.3, 1000.0});
  deform(body);
  ElasticBody turned = body;
  const Eigen::Matrix3d r = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Eigen::Vector3d away(30, -20, 5);
  for (int i = 0; i < body.node_count(); ++i) {
    turned.position_m[i] = r * body.position_m[i] + away;
    turned.velocity_mps[i] = r * body.velocity_mps[i];
  }
  StepSettings settings;
  settings.gravity_mps2.setZero();
  for (int k = 0; k < 5; ++k) {
    step_elastic(body, settings);
    step_elastic(turned, settings);
  }
  double worst = 0.0;
  for (int i = 0; i < body.node_count(); ++i)
    worst = std::max(worst, (r * body.position_m[i] + away - turned.position_m[i]).norm());
  CHECK(worst < 1e-12);
}

TEST_CASE("a rigid turn has no strain and no force") {
  ElasticBody body = block({1e9, 0.3, 1000.0});
  const Eigen::Matrix3d r = Eigen::AngleAxisd(2.3, Eigen::Vector3d(1, 1, -0.4).normalized()).toRotationMatrix();
  for (auto& x : body.position_m) x = r * x;
  for (const Element& e : body.elements) CHECK(green_strain(deformation_gradient(e, body.position_m)).norm() < 1e-13);
}

TEST_CASE("momentum stays and the energy of an unloaded body stays within five per cent of what it had") {
  for (const double young : {1e5, 1e7, 1e9}) {
    ElasticBody body = block({young, 0.3, 1000.0}, {2, 2, 6});
    deform(body);
    StepSettings settings;
    settings.gravity_mps2.setZero();
    const Eigen::Vector3d momentum = momentum_ns(body), spin = angular_momentum_nms(body);
    const double energy = kinetic_energy_j(body) + elastic_energy_j(body);
    double highest = 0.0;
    for (int k = 0; k < 300; ++k) {
      step_elastic(body, settings);
      highest = std::max(highest, kinetic_energy_j(body) + elastic_energy_j(body));
    }
    CHECK((momentum_ns(body) - momentum).norm() < 1e-9 * momentum.norm());
    CHECK((angular_momentum_nms(body) - spin).norm() < 1e-9 * spin.norm());
    CHECK(highest < 1.05 * energy);
    CHECK(kinetic_energy_j(body) + elastic_energy_j(body) < energy);
  }
}

TEST_CASE("a spinning body keeps its energy and has the strain that spin gives it") {
  ElasticBody body = block({1e8, 0.25, 1000.0}, {2, 2, 8});
  const Eigen::Vector3d centre = centre_of_mass_m(body);
  for (int i = 0; i < body.node_count(); ++i)
    body.velocity_mps[i] = Eigen::Vector3d(10, 0, 0).cross(body.position_m[i] - centre);
  const double energy = kinetic_energy_j(body);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  settings.damping_ratio = 0.1;
  for (int k = 0; k < 133; ++k) step_elastic(body, settings);
  CHECK(kinetic_energy_j(body) == relative(energy, 0.01));
  // The strain is that of the centrifugal force, ρω²r²/2Y at the middle, and not of the step.
  double largest = 0.0;
  for (const Element& e : body.elements)
    largest = std::max(largest, green_strain(deformation_gradient(e, body.position_m)).cwiseAbs().maxCoeff());
  const double expected = 1000.0 * 100.0 * 0.4 * 0.4 / 2 / 1e8;
  CHECK(largest > 0.5 * expected);
  CHECK(largest < 1.5 * expected);
}

TEST_CASE("a free body that tumbles about no principal axis keeps its angular momentum") {
  ElasticBody body = block({1e9, 0.25, 1000.0}, {1, 2, 8});
  const Eigen::Vector3d centre = centre_of_mass_m(body);
  for (int i = 0; i < body.node_count(); ++i)
    body.velocity_mps[i] = Eigen::Vector3d(6, 4, 3).cross(body.position_m[i] - centre);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  const Eigen::Vector3d spin = rigid_motion(body).angular_momentum_nms;
  const double energy = kinetic_energy_j(body);
  for (int k = 0; k < 133; ++k) step_elastic(body, settings);
  CHECK((rigid_motion(body).angular_momentum_nms - spin).norm() < 1e-9 * spin.norm());
  CHECK(kinetic_energy_j(body) == relative(energy, 0.1));
}

TEST_CASE("damping multiplies stiff modes by one minus gamma") {
  // One stiff element stretched a little: its relative motion is one mode far above the step.
  for (const double ratio : {0.0, 0.1, 0.2, 0.5}) {
    ElasticBody body = block({1e12, 0.0, 1000.0}, {1, 1, 1});
    for (int i = 0; i < body.node_count(); ++i) body.position_m[i].z() = (1.0 + 1e-6) * body.rest_position_m[i].z();
    StepSettings settings;
    settings.gravity_mps2.setZero();
    settings.damping_ratio = ratio;
    settings.tension_stiffness = false;
    const auto strain = [&] { return deformation_gradient(body.elements[0], body.position_m)(2, 2) - 1.0; };
    step_elastic(body, settings);
    CHECK(strain() / 1e-6 == doctest::Approx(1.0 - gamma_of(settings)).epsilon(1e-3).scale(1.0));
  }
}

TEST_CASE("an inverted tetrahedron turns back") {
  ElasticBody body = *make_elastic_body(lattice_mesh({1, 1, 1}, {0.1, 0.1, 0.1}), {1e7, 0.3, 1000.0});
  // The corner pushed through the opposite face of its tetrahedron: the mirrored rest shape.
  const int corner = body.body_node_of_mesh_node[0];
  body.position_m[corner] = Eigen::Vector3d(1, 1, 1) * (0.2 / 3);
  REQUIRE(least_determinant_of(body) < -0.9);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  int inverted = 0;
  for (int k = 0; k < 60; ++k) inverted += step_elastic(body, settings).inverted;
  CHECK(inverted > 0);
  CHECK(least_determinant_of(body) > 0.9);
}

TEST_CASE("numbers gone bad are counted and reset where they are") {
  ElasticBody body = block({1e8, 0.3, 1000.0});
  for (auto& v : body.velocity_mps) v = {20, 0, 0};
  body.position_m[3].x() = std::nan("");
  body.velocity_mps[7].y() = INFINITY;
  StepSettings settings;
  CHECK(step_elastic(body, settings).bad_numbers == 2);
  int later = 0;
  for (int k = 0; k < 50; ++k) later += step_elastic(body, settings).bad_numbers;
  CHECK(later == 0);
  for (const auto& x : body.position_m) CHECK(x.allFinite());
  CHECK(momentum_ns(body).x() / total_mass_kg(body) == relative(20.0, 0.01));
  CHECK(least_determinant_of(body) > 0.99);
}

TEST_CASE("both solvers agree on a tumbling stiff beam") {
  ElasticBody one = beam::make(1, {1e10, 0.25, 1000.0});
  for (int i = 0; i < one.node_count(); ++i)
    one.velocity_mps[i] = Eigen::Vector3d(5, 3, 2).cross(one.position_m[i] - Eigen::Vector3d(0, 0, 1));
  ElasticBody other = one;
  StepSettings direct, iterative;
  direct.solver = Solver::direct;
  iterative.solver = Solver::rest_factor;
  int iterations = 0;
  for (int k = 0; k < 60; ++k) {
    step_elastic(one, direct);
    const auto report = step_elastic(other, iterative);
    CHECK(report.converged);
    iterations = std::max(iterations, report.iterations);
  }
  double worst = 0.0;
  for (int i = 0; i < one.node_count(); ++i) worst = std::max(worst, (one.position_m[i] - other.position_m[i]).norm());
  CHECK(worst < 1e-3);
  CHECK(iterations < 20);
}

TEST_CASE("bad meshes and materials are refused with a message") {
  TetrahedralMesh mesh = lattice_mesh({1, 1, 1}, {1, 1, 1});
  const auto beyond = make_elastic_body(mesh, {1e9, 0.501, 1000});
  REQUIRE_FALSE(beyond.has_value());
  CHECK(describe(beyond.error()).find("Poisson's ratio is 0.501") != std::string::npos);
  CHECK(describe(beyond.error()).find("give a number from 0 to 0.5") != std::string::npos);
  CHECK_FALSE(make_elastic_body(mesh, {-1, 0.3, 1000}).has_value());
  mesh.tetrahedra[0][1] = 99;
  CHECK_FALSE(make_elastic_body(mesh, {}).has_value());
  mesh.tetrahedra[0][1] = mesh.tetrahedra[0][0];
  CHECK_FALSE(make_elastic_body(mesh, {}).has_value());
  CHECK_FALSE(make_elastic_body({}, {}).has_value());
}

TEST_CASE("a body that lies in a surface is let out of it and no faster than two metres a second") {
  for (const double depth_m : {0.001, 0.02}) {
    CAPTURE(depth_m);
    ElasticBody body = block({1e7, 0.3, 1000.0}, {1, 1, 1});
    StepSettings settings;
    settings.gravity_mps2.setZero();
    double fastest = 0.0;
    for (int k = 0; k < 60; ++k) {
      std::vector<NodeContact> contacts;
      for (int i = 0; i < body.node_count(); ++i)
        if (body.rest_position_m[i].z() < 1e-9)
          contacts.push_back({.node = i, .gap_m = body.position_m[i].z() - depth_m});
      step_elastic(body, settings, contacts);
      for (const auto& v : body.velocity_mps) fastest = std::max(fastest, v.z());
    }
    for (int i = 0; i < body.node_count(); ++i) CHECK(body.position_m[i].z() - depth_m > -0.05 * depth_m);
    CHECK(fastest > 0.0);
    CHECK(fastest < 2.5);
  }
}

TEST_CASE("a blow on one corner turns a free body by as much as its impulse has leverage") {
  ElasticBody body = block({1e8, 0.3, 1000.0}, {2, 2, 2});
  for (auto& v : body.velocity_mps) v = {0.0, 0.0, -3.0};
  StepSettings settings;
  settings.gravity_mps2.setZero();
  const RigidMotion before = rigid_motion(body);
  int corner = 0;
  for (int i = 0; i < body.node_count(); ++i)
    if (body.rest_position_m[i].norm() < 1e-9) corner = i;
  std::vector<NodeContact> contacts{{.node = corner}};
  const Eigen::Vector3d arm = body.position_m[corner] - before.centre_m;
  step_elastic(body, settings, contacts);
  REQUIRE(contacts[0].impulse_ns.z() > 0.1);
  const RigidMotion after = rigid_motion(body);
  const Eigen::Vector3d given = arm.cross(contacts[0].impulse_ns);
  CHECK((after.angular_momentum_nms - given).norm() < 1e-6 * given.norm());
  CHECK((momentum_ns(body) - total_mass_kg(body) * before.velocity_mps - contacts[0].impulse_ns).norm() <
        1e-6 * contacts[0].impulse_ns.norm());
}
