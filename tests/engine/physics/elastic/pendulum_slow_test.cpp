/// A stiff body on a hinge is a pendulum, whose time is known at any amplitude.

#include <cmath>

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/fixed_nodes.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

namespace {

struct Swing {
  double down_s = 0.0;  ///< From rest beside the hinge to straight below it.
  double rise = 0.0;    ///< Share of the centre of mass' fall that is regained.
};

/// The body is let go where its centre of mass is as high as the y-axis, which holds it.
Swing swing(ElasticBody body, const StepSettings& settings) {
  fix_nodes(body, {-1e-9, -1.0, -1e-9}, {1e-9, 2.0, 1e-9});
  const Eigen::Vector3d down = settings.gravity_mps2.normalized(), aside = down.cross(Eigen::Vector3d::UnitY());
  const auto side_m = [&] { return aside.dot(centre_of_mass_m(body)); };
  const double start_m = down.dot(centre_of_mass_m(body));
  Swing result;
  double lowest_m = start_m, top_m = start_m;
  for (double time_s = 0.0; time_s < 1.6; time_s += settings.step_s) {
    const double before_m = side_m();
    step_elastic(body, settings);
    const double after_m = side_m(), depth_m = down.dot(centre_of_mass_m(body));
    if (result.down_s == 0.0 && after_m <= 0.0)
      result.down_s = time_s + settings.step_s * before_m / (before_m - after_m);
    lowest_m = std::max(lowest_m, depth_m);
    top_m = after_m > 0.0 ? lowest_m : std::min(top_m, depth_m);
  }
  result.rise = (lowest_m - top_m) / (lowest_m - start_m);
  return result;
}

/// A quarter of the period of the rigid pendulum of the body's masses, let go 90° from its lowest place: K(sin 45°)/ω.
double quarter_period_s(const ElasticBody& body) {
  double inertia_kgm2 = 0.0;
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d& x = body.rest_position_m[i];
    inertia_kgm2 += body.mass_kg[i] * (x.x() * x.x() + x.z() * x.z());
  }
  const Eigen::Vector3d centre_m = centre_of_mass_m(body);
  const double moment_nm = total_mass_kg(body) * gravity_mps2 * std::hypot(centre_m.x(), centre_m.z());
  return std::comp_ellint_1(std::sqrt(0.5)) * std::sqrt(inertia_kgm2 / moment_nm);
}

}  // namespace

TEST_CASE("a stiff cube on a hinge swings down in a pendulum's time and rises as high as it fell from") {
  const ElasticBody cube = *make_elastic_body(lattice_mesh({2, 2, 2}, {1.0, 1.0, 1.0}), {1e8, 0.25, 1000.0});
  StepSettings settings;
  settings.gravity_mps2 = gravity_mps2 * Eigen::Vector3d(1.0, 0.0, -1.0).normalized();
  for (const Solver solver : {Solver::direct, Solver::rest_factor})
    for (const double damping_ratio : {0.0, 0.2})
      for (const double step_s : {0.002, 0.005, 0.015}) {
        CAPTURE(damping_ratio);
        CAPTURE(step_s);
        settings.solver = solver;
        settings.damping_ratio = damping_ratio;
        settings.step_s = step_s;
        const Swing result = swing(cube, settings);
        // Places are half a step ahead of velocities.
        CHECK(result.down_s + 0.5 * step_s == relative(quarter_period_s(cube), 0.002));
        CHECK(result.rise == relative(1.0, 0.002));
      }
}

TEST_CASE("a cube on a hinge is on time from 1e7 to 1e12 Pa at steps of 15 ms") {
  StepSettings settings;
  settings.gravity_mps2 = gravity_mps2 * Eigen::Vector3d(1.0, 0.0, -1.0).normalized();
  for (const Solver solver : {Solver::direct, Solver::rest_factor})
    for (const double young_pa : {1e7, 1e8, 1e9, 1e10, 1e11, 1e12}) {
      CAPTURE(young_pa);
      const ElasticBody cube = *make_elastic_body(lattice_mesh({2, 2, 2}, {1.0, 1.0, 1.0}), {young_pa, 0.25, 1000.0});
      settings.solver = solver;
      const Swing result = swing(cube, settings);
      CHECK(result.down_s + 0.5 * settings.step_s == relative(quarter_period_s(cube), 0.005));
      CHECK(result.rise == relative(1.0, 0.001));
    }
}

TEST_CASE("a cube of 1e6 Pa on a hinge is as late by its sag at steps of 15 ms as at steps of 1 ms") {
  const ElasticBody cube = *make_elastic_body(lattice_mesh({2, 2, 2}, {1.0, 1.0, 1.0}), {1e6, 0.25, 1000.0});
  StepSettings settings;
  settings.gravity_mps2 = gravity_mps2 * Eigen::Vector3d(1.0, 0.0, -1.0).normalized();
  const Swing coarse = swing(cube, settings);
  const double coarse_s = coarse.down_s + 0.5 * settings.step_s;
  settings.step_s = 0.001;
  const Swing fine = swing(cube, settings);
  CHECK(coarse_s == relative(fine.down_s + 0.5 * settings.step_s, 0.005));
}
