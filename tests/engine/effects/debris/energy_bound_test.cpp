/// A bound of energy takes some away, and what has flowed stays.

#include "engine/effects/debris/energy_bound.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// How far the ends have moved ahead of the middle.
double bend_m(const Piece& piece) {
  const auto& body = piece.body;
  double ends_m = 0.0, middle_m = 0.0;
  int end_count = 0, middle_count = 0;
  double longest_m = 0.0;
  for (const auto& x : body.rest_position_m) longest_m = std::max(longest_m, std::abs(x.y()));
  for (int i = 0; i < body.node_count(); ++i) {
    const double along = std::abs(body.rest_position_m[i].y()) / longest_m;
    if (along > 0.99) ends_m += body.position_m[i].x() - body.rest_position_m[i].x(), ++end_count;
    if (along < 0.01) middle_m += body.position_m[i].x() - body.rest_position_m[i].x(), ++middle_count;
  }
  REQUIRE(end_count > 0);
  REQUIRE(middle_count > 0);
  return ends_m / end_count - middle_m / middle_count;
}

/// A bumper whose natural shape is bent by 0.3 m, as flow leaves it, and that is stretched by a thousandth.
Piece bent_bumper() {
  Piece bumper = part_at_rest(Part::bumper);
  auto& body = bumper.body;
  double longest_m = 0.0;
  for (const auto& x : body.rest_position_m) longest_m = std::max(longest_m, std::abs(x.y()));
  for (int i = 0; i < body.node_count(); ++i) {
    const double along = body.rest_position_m[i].y() / longest_m;
    body.position_m[i] = body.rest_position_m[i] + Eigen::Vector3d(0.3 * along * along, 0.0, 0.0);
  }
  for (auto& e : body.elements) {
    Eigen::Matrix3d edges;
    for (int a = 0; a < 3; ++a) edges.col(a) = body.position_m[e.nodes[a + 1]] - body.position_m[e.nodes[0]];
    e.rest_inverse = edges.inverse();
  }
  for (auto& x : body.position_m) x.y() *= 1.001;
  for (auto& v : body.velocity_mps) v = {3.0, 0.0, 0.0};
  return bumper;
}

}  // namespace

TEST_CASE("a bound of energy leaves a bent bumper bent, with no more energy than is allowed") {
  for (const double share : {0.9, 0.5, 0.01}) {
    CAPTURE(share);
    Piece bumper = bent_bumper();
    const double stored_j = elastic::elastic_energy_j(bumper.body), moving_j = elastic::kinetic_energy_j(bumper.body);
    CHECK(stored_j > 1.0);
    Frame frame;
    frame.allowed_j = share * stored_j + moving_j;
    for (int call = 0; call < 2; ++call) {
      bound_energy(bumper, frame);
      CHECK(elastic::elastic_energy_j(bumper.body) + elastic::kinetic_energy_j(bumper.body) <
            frame.allowed_j * (1.0 + 1e-6));
      CHECK(bend_m(bumper) == relative(0.3, 0.01));
    }
    const Eigen::Vector3d momentum_ns = elastic::momentum_ns(bumper.body);
    CHECK((momentum_ns - Eigen::Vector3d(3.0 * elastic::total_mass_kg(bumper.body), 0.0, 0.0)).norm() < 1e-9);
  }
}
