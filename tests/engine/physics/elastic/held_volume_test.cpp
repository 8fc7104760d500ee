// Solids of Poisson's ratio one half.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

constexpr double cube_young_pa = 1e8, cube_side_m = 0.3;

/// A free cube, pulled at two faces and stepped until it rests. Steps are short, because the pull keeps its direction and
/// holds the cube upright as a stiff spring would.
ElasticBody pulled_cube(double poisson_ratio, double traction_pa, Solver solver) {
  ElasticBody cube = *make_elastic_body(lattice_mesh({3, 3, 3}, {cube_side_m, cube_side_m, cube_side_m}),
                                        {cube_young_pa, poisson_ratio, 1000.0});
  beam::load_face(cube, beam::at_start, -traction_pa);
  beam::load_face(
      cube, [](const ElasticBody& b, int i) { return b.rest_position_m[i].z() > cube_side_m - 1e-9; }, traction_pa);
  StepSettings settings;
  settings.gravity_mps2.setZero();
  settings.step_s = 0.002;
  settings.damping_ratio = 0.5;
  settings.solver = solver;
  settings.tolerance = 1e-8;
  for (int k = 0; k < 150; ++k) step_elastic(cube, settings);
  return cube;
}

double strain_along(const ElasticBody& cube, int axis) {
  double low = INFINITY, high = -INFINITY;
  for (const auto& x : cube.position_m) low = std::min(low, x[axis]), high = std::max(high, x[axis]);
  return (high - low) / cube_side_m - 1.0;
}

}  // namespace

TEST_CASE("an incompressible cube under tension keeps its volume and has its Young's modulus") {
  for (const Solver solver : {Solver::direct, Solver::rest_factor})
    for (const double load : {1e-4, 1e-2}) {
      CAPTURE(load);
      const ElasticBody cube = pulled_cube(0.5, load * cube_young_pa, solver);
      const double gained = volume_m3(cube) / (cube_side_m * cube_side_m * cube_side_m) - 1.0;
      CHECK(std::abs(gained) < 1e-3);
      CHECK(std::abs(gained) < 2.0 * load * load);  // Green's trace zero is determinant one but for the square.
      CHECK(strain_along(cube, 2) == relative(beam::st_venant_kirchhoff_strain(load), 0.01));
      CHECK(strain_along(cube, 0) == relative(-0.5 * strain_along(cube, 2), 0.02));
      // The stress is the load along the axis and nothing across it.
      for (int e = 0; e < static_cast<int>(cube.elements.size()); ++e) {
        const Eigen::Matrix3d stress = cauchy_stress_pa(cube, e);
        CHECK(stress(2, 2) == relative(load * cube_young_pa, 0.03));
        CHECK(std::abs(stress(0, 0)) < 0.03 * load * cube_young_pa);
      }
    }
  // A quarter is not one half.
  CHECK(volume_m3(pulled_cube(0.25, 1e-2 * cube_young_pa, Solver::direct)) / std::pow(cube_side_m, 3) - 1.0 > 4e-3);
}

TEST_CASE("Poisson's ratio one half is the limit of ratios below it") {
  const double bend = beam::static_bend_ratio(2, 0.4998), twist = beam::static_twist_ratio(2, 0.4998);
  CHECK(beam::static_bend_ratio(2, 0.5) == relative(bend, 0.005));
  CHECK(beam::static_twist_ratio(2, 0.5) == relative(twist, 0.005));
}

TEST_CASE("an incompressible body falls swings and keeps its momentum as others do") {
  ElasticBody body = *make_elastic_body(lattice_mesh({2, 2, 6}, {0.2, 0.2, 0.6}), {1e6, 0.5, 1000.0});
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d& x = body.rest_position_m[i];
    body.velocity_mps[i] = {2.0 + x.z(), -0.5 * x.x(), 3.0 * x.y()};
  }
  StepSettings settings;
  settings.gravity_mps2.setZero();
  const Eigen::Vector3d momentum = momentum_ns(body), spin = angular_momentum_nms(body);
  const double energy = kinetic_energy_j(body), volume = volume_m3(body);
  for (int k = 0; k < 300; ++k) {
    step_elastic(body, settings);
    CHECK(kinetic_energy_j(body) + elastic_energy_j(body) < 1.05 * energy);
    CHECK(volume_m3(body) == relative(volume, 1e-2));
  }
  CHECK((momentum_ns(body) - momentum).norm() < 1e-9 * momentum.norm());
  CHECK((angular_momentum_nms(body) - spin).norm() < 1e-9 * spin.norm());
}
