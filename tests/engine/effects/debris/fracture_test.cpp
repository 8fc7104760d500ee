// Opening faces and their cost.

#include "engine/effects/debris/fracture.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// Stretched along x until its stress is this share of its strength.
Piece slab_pulled_to(double share_of_strength) {
  Piece slab = part_at_rest(Part::ice_slab);
  const auto& m = slab.material;
  const double strain = share_of_strength * m.strength_pa / m.elastic.young_modulus_pa;
  for (auto& x : slab.body.position_m)
    x = {x.x() * (1.0 + strain), x.y() * (1.0 - m.elastic.poisson_ratio * strain),
         x.z() * (1.0 - m.elastic.poisson_ratio * strain)};
  return slab;
}

/// A slab of ice of two splinters that meet in the plane x = 0: ten triangles. A step carries a pull along x through
/// it.
Piece slab_of_two(double carried_share_of_strength) {
  Piece slab = part_at_rest(Part::ice_slab);
  for (std::size_t k = 0; k < slab.body.elements.size(); ++k) {
    double x = 0.0;
    for (const int node : slab.body.elements[k].nodes) x += slab.body.rest_position_m[node].x();
    slab.splinter[k] = x < 0.0 ? 0 : 1;
  }
  const Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  slab.body.step_stress_pa.assign(slab.body.elements.size(),
                                  carried_share_of_strength * slab.material.strength_pa * along * along.transpose());
  return slab;
}

const PartRecipe& ice = part_recipe(Part::ice_slab);
/// Of one of the ten.
double crack_j(const Piece& slab) { return 0.1 * ice.size_m.y * ice.size_m.z * slab.material.fracture_energy_jpm2; }

Blow blow_with(double lost_j, double stress_factor) {
  Blow blow;
  blow.lost_j = lost_j;
  blow.stress_factor = stress_factor;
  return blow;
}

}  // namespace

TEST_CASE("a slab pulled to just below its strength holds and just beyond it breaks") {
  CHECK(fracture(slab_pulled_to(0.99)).opened_faces == 0);
  CHECK(fracture(slab_pulled_to(1.01)).opened_faces > 0);
  CHECK(fracture(slab_pulled_to(-1.5)).opened_faces == 0);  // Pressed.
  // A step's transmitted load counts like the shape's.
  CHECK(fracture(slab_of_two(0.99)).opened_faces == 0);
  CHECK(fracture(slab_of_two(1.01)).opened_faces == 10);
}

TEST_CASE("only faces across the pull open") {
  Piece slab = slab_of_two(0.0);
  const auto pulled_along = [&](const Eigen::Vector3d& way) {
    slab.body.step_stress_pa.assign(slab.body.elements.size(), 2.0 * slab.material.strength_pa * way * way.transpose());
    return fracture(slab).opened_faces;
  };
  CHECK(pulled_along(Eigen::Vector3d::UnitY()) == 0);
  CHECK(pulled_along(Eigen::Vector3d(std::cos(0.75), std::sin(0.75), 0.0)) == 10);  // 43° off the face's normal.
  CHECK(pulled_along(Eigen::Vector3d(std::cos(0.82), std::sin(0.82), 0.0)) == 0);   // 47°.
}

TEST_CASE("cracks of a blow open as far as what it lost pays for") {
  const Piece slab = slab_of_two(0.5);
  const double cost_j = crack_j(slab);
  for (const double paid : {0.5, 3.5, 7.5}) {
    CAPTURE(paid);
    CHECK(fracture(slab, blow_with(paid * cost_j, 4.0)).opened_faces == static_cast<int>(paid));
  }
  CHECK(fracture(slab, blow_with(20.0 * cost_j, 4.0)).opened_faces == 10);
  // The work of lasting pressure pays as well.
  Blow pressed = blow_with(1.5 * cost_j, 4.0);
  pressed.pressed_j = 3.0 * cost_j;
  CHECK(fracture(slab, pressed).opened_faces == 4);
}

TEST_CASE("a blow breaks where its peak passes the strength and not where it stays below") {
  const Piece slab = slab_of_two(0.1);
  const double plenty_j = 100.0 * crack_j(slab);
  CHECK(fracture(slab, blow_with(plenty_j, 9.9)).opened_faces == 0);
  CHECK(fracture(slab, blow_with(plenty_j, 10.1)).opened_faces == 10);
  CHECK(fracture(slab, blow_with(0.0, 10.1)).opened_faces == 0);
}

TEST_CASE("pressure splits ice along it where it would bulge by more than its strength") {
  Piece slab = slab_of_two(0.0);
  const auto& m = slab.material;
  const double splitting_pa = std::min(m.compressive_strength_pa, m.strength_pa / m.elastic.poisson_ratio);
  const auto pressed = [&](const Eigen::Vector3d& way, double share) {
    slab.body.step_stress_pa.assign(slab.body.elements.size(), -0.1 * share * splitting_pa * way * way.transpose());
    return fracture(slab, blow_with(1e3, 10.0)).opened_faces;
  };
  CHECK(pressed(Eigen::Vector3d::UnitZ(), 0.99) == 0);
  CHECK(pressed(Eigen::Vector3d::UnitZ(), 1.01) == 10);
  CHECK(pressed(Eigen::Vector3d::UnitX(), 1.01) == 0);  // The face lies across the pressure, not along it.
}

TEST_CASE("a fifth of what the cracks leave of a blow scatters the fragments") {
  Piece slab = slab_of_two(0.5);
  const double left_j = 40.0;
  const FractureResult result = fracture(slab, blow_with(10.0 * crack_j(slab) + left_j, 4.0));
  REQUIRE(result.pieces.size() == 2);
  double energy_j = 0.0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (const Piece& p : result.pieces) {
    energy_j += elastic::kinetic_energy_j(p.body);
    momentum += elastic::momentum_ns(p.body);
    const double side = elastic::centre_of_mass_m(p.body).x();
    CHECK(side * elastic::momentum_ns(p.body).x() > 0.0);  // Apart.
  }
  CHECK(energy_j == relative(scatter_share * left_j, 1e-6));
  CHECK(momentum.norm() < 1e-9);
  // Lasting pressure pays for cracks and scatters nothing.
  Blow pressed = blow_with(1e-9, 4.0);
  pressed.pressed_j = 100.0;
  double pressed_j = 0.0;
  for (const Piece& p : fracture(slab, pressed).pieces) pressed_j += elastic::kinetic_energy_j(p.body);
  CHECK(pressed_j < 1e-8);
}
