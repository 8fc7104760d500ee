// One tetrahedron pressed flat, with a closed-form solution.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/elastic_body.hpp"
#include "engine/physics/elastic/element.hpp"
#include "engine/physics/elastic/step.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/relative.hpp"

using namespace septet::elastic;
using septet::relative;

namespace {

constexpr double young_pa = 1e6;

ElasticBody pressed_to(double volume_share) {
  TetrahedralMesh mesh;
  mesh.nodes_m = {{0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}, {0, 0, 0.1}};
  mesh.tetrahedra = {{0, 1, 2, 3}};
  ElasticBody body = *make_elastic_body(mesh, {young_pa, 0.3, 1000.0});
  for (auto& x : body.position_m) x *= std::cbrt(volume_share);
  return body;
}

/// F = s I: the stress is s (3λ + 2μ) e I with e = (s² − 1)/2, and below three tenths (λ + 2μ)(s³ − 0.3) s² I besides.
double pressure_pa(double volume_share) {
  const LameConstants lame = lame_constants({young_pa, 0.3, 1000.0});
  const double s = std::cbrt(volume_share), e = 0.5 * (s * s - 1.0);
  const double missing = std::min(0.0, volume_share - 0.3);
  return -(s * (3.0 * lame.lambda_pa + 2.0 * lame.mu_pa) * e + (lame.lambda_pa + 2.0 * lame.mu_pa) * missing * s * s);
}

}  // namespace

TEST_CASE("a tetrahedron pressed below three tenths of its volume is pushed back with lambda plus two mu") {
  for (const double share : {0.05, 0.1, 0.2, 0.28, 0.32, 0.9, 1.1}) {
    CAPTURE(share);
    ElasticBody body = pressed_to(share);
    const Element& e = body.elements.front();
    const auto gradients = shape_gradients(e);
    StepSettings settings;
    settings.step_s = 1e-6;  // So short that a step is its force times its time.
    settings.gravity_mps2.setZero();
    const ElasticBody before = body;
    CHECK(step_elastic(body, settings).inverted == 0);
    for (std::size_t a = 0; a < 4; ++a) {
      const int node = e.nodes[a];
      const Eigen::Vector3d expected_n = e.rest_volume_m3 * pressure_pa(share) * gradients[a];
      CHECK((internal_forces_n(before)[node] - expected_n).norm() < 1e-9 * expected_n.norm());
      const Eigen::Vector3d got_n = body.mass_kg[node] * body.velocity_mps[node] / settings.step_s;
      CHECK((got_n - expected_n).norm() < 1e-3 * expected_n.norm());
    }
  }
}

TEST_CASE("the stress of an element is that of its present shape and stays finite where it is flat") {
  for (const double share : {0.5, 0.9, 1.2}) {
    // Over the present area, s² of that at rest.
    const double expected_pa = -pressure_pa(share) / std::pow(std::cbrt(share), 2);
    const Eigen::Matrix3d stress = cauchy_stress_pa(pressed_to(share), 0);
    CHECK((stress - expected_pa * Eigen::Matrix3d::Identity()).norm() < 1e-9 * std::abs(expected_pa));
  }
  CHECK(cauchy_stress_pa(pressed_to(1e-9), 0).norm() < 10.0 * young_pa);
}

TEST_CASE("a step that presses further is held by the stiffness of the volume as well") {
  // All corners rush to the middle; the implicit step slows them more the further they would come.
  const auto slowed_by = [](double share) {
    ElasticBody body = pressed_to(share);
    const Eigen::Vector3d middle = centre_of_mass_m(body);
    for (int i = 0; i < body.node_count(); ++i) body.velocity_mps[i] = -100.0 * (body.position_m[i] - middle);
    const double before_j = kinetic_energy_j(body);
    StepSettings settings;
    settings.step_s = 1e-4;
    settings.gravity_mps2.setZero();
    const ElasticBody still = pressed_to(share);
    ElasticBody pushed = still;
    step_elastic(pushed, settings);
    step_elastic(body, settings);
    // Without the present shape's elastic energy.
    double after_j = 0.0;
    for (int i = 0; i < body.node_count(); ++i)
      after_j += 0.5 * body.mass_kg[i] * (body.velocity_mps[i] - pushed.velocity_mps[i]).squaredNorm();
    return std::sqrt(before_j / after_j) - 1.0;
  };
  // Rate of a uniform squeeze: Δt²/γ K over the mass, K of the volume's constraint from c = s² and of the strain from
  // s.
  const LameConstants lame = lame_constants({young_pa, 0.3, 1000.0});
  const double g2 = 100.0, mass_over_volume = 1000.0;
  for (const double share : {0.2, 0.5}) {
    CAPTURE(share);
    const double s = std::cbrt(share);
    double stiffness = s * s * (3.0 * lame.lambda_pa + 2.0 * lame.mu_pa);
    if (share < 0.3) stiffness += 3.0 * s * s * s * s * (lame.lambda_pa + 2.0 * lame.mu_pa);
    // A squeeze at unit rate moves the corners of this tetrahedron by 3/16 of the squared edge times the mass.
    const double inertia = mass_over_volume * 9.0 / 16.0 / g2;
    StepSettings settings;
    const double expected = 1e-8 / gamma_of(settings) * 3.0 * stiffness / inertia;
    CHECK(slowed_by(share) == relative(expected, 0.02));
  }
}
