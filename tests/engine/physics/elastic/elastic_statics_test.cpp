#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/physics/elastic/beam.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::elastic;

TEST_CASE(
    "a beam of one cell pulled a little stretches as Hooke says but for the second order and less where it is "
    "clamped") {
  // St. Venant and Kirchhoff's strain is Hooke's less 1.5 times its square: 0.9985 of it here.
  const double free = beam::static_stretch(1, 1e-3, true) / 1e-3, clamped = beam::static_stretch(1, 1e-3, false) / 1e-3;
  CHECK(free == relative(beam::st_venant_kirchhoff_strain(1e-3) / 1e-3, 1e-4));
  CHECK(free == relative(1.0 - 1.5e-3, 1e-4));
  // The clamp keeps the first of 21 cubes from growing thinner.
  CHECK(clamped < free);
  CHECK(clamped > 0.995 * free);
}

TEST_CASE("pulled and pushed hard it follows St. Venant-Kirchhoff and not Hooke") {
  const double pulled = beam::st_venant_kirchhoff_strain(0.1);
  const double pushed = beam::st_venant_kirchhoff_strain(-0.1);
  CHECK(pulled / 0.1 == relative(0.8803, 0.001));  // Hooke would say 1.
  CHECK(pushed / -0.1 == relative(1.211, 0.002));
  CHECK(beam::static_stretch(1, 0.1, true) == relative(pulled, 0.005));
  CHECK(beam::static_push_strain(1, -0.1) == relative(pushed, 0.005));
}

TEST_CASE("torsion of coarse linear tetrahedra is five times too stiff and converges") {
  CHECK(beam::static_twist_ratio(1) == relative(0.21, 0.05));
  CHECK(beam::static_twist_ratio(2) == relative(0.48, 0.05));
}

TEST_CASE("bending of coarse linear tetrahedra converges from below") {
  CHECK(beam::static_bend_ratio(1) == relative(0.36, 0.05));
  CHECK(beam::static_bend_ratio(2) == relative(0.68, 0.05));
}

TEST_CASE("Young's modulus and the Poisson ratio give the right Lame constants") {
  const LameConstants m = lame_constants({2.5e9, 0.25, 1});
  CHECK(m.mu_pa * (3 * m.lambda_pa + 2 * m.mu_pa) / (m.lambda_pa + m.mu_pa) == doctest::Approx(2.5e9));
  CHECK(m.lambda_pa / (2 * (m.lambda_pa + m.mu_pa)) == doctest::Approx(0.25));
}

TEST_CASE("a beam at rest hangs at a depth that goes with one over the stiffness") {
  double first = 0.0;
  for (const double young : {1e8, 1e9, 1e10, 1e11, 1e12}) {
    // 990 tetrahedra, 0.3 × 0.3 × 2.2 m: known to hang by 0.0318 m at 100 MPa.
    ElasticBody body = *make_elastic_body(lattice_mesh({3, 3, 22}, {0.3, 0.3, 2.2}), {young, 0.25, 1000.0});
    fix_nodes(body, {-1, -1, -1e-9}, {1, 1, 1e-9});
    REQUIRE(find_equilibrium(body, {-9.81, 0, 0}).converged);
    double deepest = 0.0;
    for (const auto& x : body.position_m) deepest = std::min(deepest, x.x());
    if (first == 0.0) {
      first = deepest * young;
      CHECK(deepest == relative(-0.0318, 0.01));
    }
    CHECK(deepest * young == relative(first, 0.01));
  }
}

TEST_CASE("what is called converged is in balance at every node that is free") {
  ElasticBody body = beam::make(1, {1e6, 0.25, 1000.0});
  beam::clamp_start(body);
  const Eigen::Vector3d gravity(0.0, -9.81, 0.0);
  REQUIRE(find_equilibrium(body, gravity).converged);
  const auto internal = internal_forces_n(body);
  for (int i = 0; i < body.node_count(); ++i)
    if (!body.fixed[i]) CHECK((internal[i] + body.mass_kg[i] * gravity).norm() < 1e-5 * body.mass_kg[i] * 9.81);
}
