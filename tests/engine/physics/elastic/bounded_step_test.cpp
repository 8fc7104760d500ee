#include "tests/engine/physics/elastic/bounded_step.hpp"

#include <doctest/doctest.h>

#include "beam.hpp"

using namespace septet::elastic;

namespace {

ElasticBody twisted_beam(double young_pa, int cells_across) {
  ElasticBody body = beam::make(cells_across, {young_pa, 0.25, 1000.0});
  beam::clamp_start(body);
  const Eigen::Vector3d axis(0.5 * beam::side_m, 0.5 * beam::side_m, 0.0);
  for (int i = 0; i < body.node_count(); ++i) {
    const Eigen::Vector3d arm = body.rest_position_m[i] - axis;
    body.position_m[i] = Eigen::AngleAxisd(arm.z() / beam::length_m, Eigen::Vector3d::UnitZ()) * arm + axis;
  }
  return body;
}

double energy_j(const ElasticBody& body) { return kinetic_energy_j(body) + elastic_energy_j(body); }

}  // namespace

TEST_CASE("a clamped beam let go from a twist of a radian loses energy at steps of 15 ms from 1 MPa to 1 GPa") {
  for (const double young_pa : {1e6, 1e8, 1e9}) {
    INFO("Young's modulus " << young_pa);
    ElasticBody body = twisted_beam(young_pa, 1);
    StepSettings settings;
    settings.gravity_mps2.setZero();
    double last = energy_j(body);
    const double first = last;
    int steps = 0;
    for (int k = 0; k < 60; ++k) {
      const BoundedStepReport report = step_within_energy(body, settings);
      CHECK(report.bounded);
      steps += report.steps;
      REQUIRE(energy_j(body) <= 1.002 * last);
      last = energy_j(body);
    }
    CHECK(last < 0.1 * first);
    CHECK(steps < 30 * 60);
  }
}

TEST_CASE("the plain step gains energy where elements turn far and the limit of that is known") {
  const auto highest = [](double step_s, double damping_ratio) {
    ElasticBody body = twisted_beam(1e8, 1);
    StepSettings settings;
    settings.gravity_mps2.setZero();
    settings.step_s = step_s;
    settings.damping_ratio = damping_ratio;
    const double first = energy_j(body);
    double most = 0.0;
    for (int k = 0; k < static_cast<int>(0.6 / step_s); ++k) {
      step_elastic(body, settings);
      most = std::max(most, energy_j(body));
    }
    return most / first;
  };
  CHECK(highest(0.015, 0.2) > 1.5);
  CHECK(highest(0.004, 0.2) < 1.0);
  CHECK(highest(0.015, 0.5) < 1.0);
}

TEST_CASE("where nothing turns far a step is made once and is the plain one") {
  ElasticBody plain = beam::make(1), bounded = beam::make(1);
  beam::clamp_start(plain);
  beam::clamp_start(bounded);
  StepSettings settings;
  for (int k = 0; k < 30; ++k) {
    step_elastic(plain, settings);
    CHECK(step_within_energy(bounded, settings).steps == 1);
  }
  for (int i = 0; i < plain.node_count(); ++i) REQUIRE(plain.position_m[i] == bounded.position_m[i]);
}
