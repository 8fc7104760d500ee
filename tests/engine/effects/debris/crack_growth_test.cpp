// Cracks in ice before they open.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// Of a slab's element.
Eigen::Vector3d middle_of_element(const Piece& slab, std::size_t element) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : slab.body.elements[element].nodes) sum += 0.25 * slab.body.rest_position_m[node];
  return sum;
}

void pull(Piece& slab, double share_of_strength) {
  const Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  slab.body.step_stress_pa.assign(slab.body.elements.size(),
                                  share_of_strength * slab.material.strength_pa * along * along.transpose());
}

/// A part in two or three splinters along x that meet at x = 0, and at x = 0.5: ten triangles each.
Piece in_splinters(Part part, int count) {
  Piece piece = part_at_rest(part);
  for (std::size_t k = 0; k < piece.body.elements.size(); ++k)
    piece.splinter[k] = middle_of_element(piece, k).x() < 0.0                 ? 0
                        : count == 3 && middle_of_element(piece, k).x() > 0.5 ? 2
                                                                              : 1;
  return piece;
}

Blow blow_that_lost(double lost_j, double stress_factor) {
  Blow blow;
  blow.lost_j = lost_j;
  blow.stress_factor = stress_factor;
  return blow;
}

using Corners = std::array<Vec3, 3>;
/// Places of a piece's cracks at rest, the first corner first.
std::vector<Corners> cracks_told(const Piece& piece) {
  const auto sent = decode(encode(keyframe_of(piece)));
  REQUIRE(sent);
  std::vector<Corners> places;
  for (const Keyframe::Crack& crack : sent->cracks)
    places.push_back({sent->rest_m[crack.corners[0]], sent->rest_m[crack.corners[1]], sent->rest_m[crack.corners[2]]});
  return places;
}

}  // namespace

TEST_CASE("under a lasting pull a crack of ice grows as Kachanov's law says until its face opens") {
  for (const double share : {0.9, 0.6}) {
    CAPTURE(share);
    Piece slab = in_splinters(Part::ice_slab, 2);
    pull(slab, share);
    const double rupture_s = crack_time_s / (crack_exponent + 1.0) * std::pow(share, -crack_exponent);
    // It parts once the remainder is overloaded: at a = 1 − share.
    const double opens_s = rupture_s * (1.0 - std::pow(share, crack_exponent + 1.0)), step_s = 4e-3 * opens_s;
    double time_s = 0.0;
    for (const double until : {0.25, 0.5, 0.75, 0.95}) {
      for (; time_s < until * opens_s; time_s += step_s) {
        FractureResult result = fracture(slab, {}, step_s);
        REQUIRE(result.opened_faces == 0);
        slab.cracks = std::move(result.cracks);
      }
      REQUIRE(slab.cracks.size() == 10);
      const double expected = 1.0 - std::pow(1.0 - time_s / rupture_s, 1.0 / (crack_exponent + 1.0));
      CHECK(slab.cracks.front().reach == relative(expected, 0.03));
    }
    int opened = 0;
    for (; opened == 0 && time_s < 1.1 * opens_s; time_s += step_s) {
      FractureResult result = fracture(slab, {}, step_s);
      opened = result.opened_faces;
      slab.cracks = std::move(result.cracks);
    }
    CHECK(opened == 10);
    CHECK(time_s / opens_s == relative(1.0, 0.03));
  }
}

TEST_CASE("nothing cracks that is pulled by little, pressed, or not of ice") {
  for (const double share : {0.35, -0.9}) {
    Piece slab = in_splinters(Part::ice_slab, 2);
    pull(slab, share);
    CHECK(fracture(slab, {}, 100.0).cracks.empty());
  }
  Piece post = in_splinters(Part::barrier_post, 2);
  pull(post, 0.9);
  CHECK(fracture(post, {}, 0.1).cracks.empty());
}

TEST_CASE("a blow that cannot pay for a face cracks it as far as it pays and the next one pays the rest") {
  Piece slab = in_splinters(Part::ice_slab, 2);
  pull(slab, 0.3);
  const double cost_j = 0.1 * part_recipe(Part::ice_slab).size_m.y * part_recipe(Part::ice_slab).size_m.z *
                        slab.material.fracture_energy_jpm2;
  FractureResult result = fracture(slab, blow_that_lost(0.6 * cost_j, 6.0));
  CHECK(result.opened_faces == 0);
  REQUIRE(result.cracks.size() == 1);
  CHECK(result.cracks[0].reach == relative(0.6, 1e-6));
  slab.cracks = result.cracks;
  result = fracture(slab, blow_that_lost(0.5 * 0.4 * cost_j, 6.0));
  CHECK(result.opened_faces == 0);
  REQUIRE(result.cracks.size() == 1);
  CHECK(result.cracks[0].reach == relative(0.8, 1e-6));
  slab.cracks = result.cracks;
  CHECK(fracture(slab, blow_that_lost(0.21 * cost_j, 6.0)).opened_faces == 1);
  CHECK(fracture(in_splinters(Part::ice_slab, 2), blow_that_lost(0.21 * cost_j, 6.0)).opened_faces == 0);
}

TEST_CASE("a cracked face opens at the share of its strength that is left") {
  Piece slab = in_splinters(Part::ice_slab, 2);
  pull(slab, 0.5);
  for (int i = 0; i < 200 && (slab.cracks.empty() || slab.cracks.front().reach < 0.3); ++i)
    slab.cracks = fracture(slab, {}, 0.05).cracks;
  REQUIRE(slab.cracks.size() == 10);
  const double left = 1.0 - slab.cracks.front().reach;
  pull(slab, 0.99 * left);
  CHECK(fracture(slab).opened_faces == 0);
  pull(slab, 1.01 * left);
  CHECK(fracture(slab).opened_faces == 10);
}

TEST_CASE("a crack stays where it is in the ice and as long as it is when the slab breaks elsewhere") {
  Piece slab = in_splinters(Part::ice_slab, 3);
  pull(slab, 0.6);
  slab.cracks = fracture(slab, {}, 3.0).cracks;
  REQUIRE(slab.cracks.size() == 20);
  std::vector<Corners> before = cracks_told(slab);
  // A pull at the right end alone.
  for (std::size_t k = 0; k < slab.body.elements.size(); ++k)
    if (middle_of_element(slab, k).x() < 0.25) slab.body.step_stress_pa[k].setZero();
  slab.body.step_stress_pa.front().setZero();
  for (auto& stress : slab.body.step_stress_pa) stress *= 2.0;
  const FractureResult broken = fracture(slab);
  REQUIRE(broken.opened_faces == 10);
  REQUIRE(broken.pieces.size() == 2);
  std::size_t cracks = 0;
  for (const Piece& piece : broken.pieces) {
    for (const FaceCrack& crack : piece.cracks) CHECK(crack.reach == slab.cracks.front().reach);
    for (const Corners& place : cracks_told(piece)) {
      ++cracks;
      const auto found = std::ranges::find(before, place);
      CHECK(found != before.end());  // To the millimetre of the wire, the corner from which it grows first.
      if (found != before.end()) CHECK(std::abs((*found)[0].x) < 1e-9);
    }
  }
  CHECK(cracks == 10);
}

TEST_CASE("cracks come back from the wire and what is wrong with them is refused") {
  Piece slab = in_splinters(Part::ice_slab, 2);
  pull(slab, 0.6);
  slab.cracks = fracture(slab, {}, 3.0).cracks;
  const Keyframe sent = keyframe_of(slab);
  REQUIRE(sent.cracks.size() == 10);
  const Bytes good = encode(sent);
  const auto received = decode(good);
  REQUIRE(received);
  for (std::size_t i = 0; i < sent.cracks.size(); ++i) {
    CHECK(received->cracks[i].corners == sent.cracks[i].corners);
    CHECK(received->cracks[i].reach == sent.cracks[i].reach);
  }
  for (std::size_t length = good.size() - 60; length < good.size(); ++length)
    CHECK_FALSE(decode(std::span(good).first(length)).has_value());
  Bytes announced = encode([&] {
    Keyframe none = sent;
    none.cracks.clear();
    return none;
  }());
  announced[0] = std::byte{3};
  announced.push_back(std::byte{0});
  CHECK_FALSE(decode(announced).has_value());
}
