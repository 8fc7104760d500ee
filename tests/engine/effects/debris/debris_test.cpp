#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <glm/geometric.hpp>

#include "engine/effects/debris/contacts.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "engine/physics/elastic/element.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

TEST_CASE("every part has the mass of its recipe") {
  for (int i = 0; i < part_count; ++i) {
    const auto part = static_cast<Part>(i);
    CHECK(elastic::total_mass_kg(part_at_rest(part).body) == relative(part_recipe(part).mass_kg, 0.02));
  }
}

TEST_CASE("fracture keeps mass and momentum and angular momentum") {
  Piece slab = part_at_rest(Part::ice_slab);
  for (int i = 0; i < slab.body.node_count(); ++i) {
    auto& x = slab.body.position_m[i];
    slab.body.velocity_mps[i] = {x.y(), 3.0 - x.x() * x.y(), 2.0 * x.x()};
    x.x() *= 1.001;  // A thousandth longer: 9 MPa where 1.2 is its strength.
  }
  const FractureResult result = fracture(slab);
  REQUIRE(result.opened_faces > 0);
  REQUIRE(result.pieces.size() > 1);
  double mass = 0.0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero(), spin = momentum;
  std::size_t elements = 0;
  for (const Piece& p : result.pieces) {
    mass += elastic::total_mass_kg(p.body);
    momentum += elastic::momentum_ns(p.body);
    spin += elastic::angular_momentum_nms(p.body);
    elements += p.body.elements.size();
  }
  CHECK(elements == slab.body.elements.size());
  CHECK(mass == relative(elastic::total_mass_kg(slab.body), 1e-12));
  CHECK((momentum - elastic::momentum_ns(slab.body)).norm() < 1e-10 * momentum.norm());
  CHECK((spin - elastic::angular_momentum_nms(slab.body)).norm() < 1e-10 * spin.norm());
}

TEST_CASE("a part below its strength stays whole") {
  Piece slab = part_at_rest(Part::ice_slab);
  for (auto& x : slab.body.position_m) x.z() += 1e-6 * x.x() * x.x();
  CHECK(fracture(slab).opened_faces == 0);
}

TEST_CASE("steel flows past its yield stress and keeps volume and part of its new shape") {
  Piece block = tetrahedron({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, Material::steel_sheet);
  for (auto& x : block.body.position_m) x.x() *= 1.02;  // Two per cent; steel yields at 0.1.
  const auto before = elastic::elastic_energy_j(block.body);
  REQUIRE(flow(block).elements == static_cast<int>(block.body.elements.size()));
  CHECK(elastic::elastic_energy_j(block.body) < before);
  for (const auto& e : block.body.elements) {
    Eigen::Matrix3d edges;
    for (int a = 0; a < 3; ++a)
      edges.col(a) = block.body.rest_position_m[e.nodes[a + 1]] - block.body.rest_position_m[e.nodes[0]];
    const Eigen::Matrix3d inverse_flow = edges * e.rest_inverse;
    CHECK(inverse_flow.determinant() == relative(1.0, 1e-9));
    CHECK(inverse_flow(0, 0) < 0.99);  // Its rest length grew by more than one per cent.
  }
  Piece glass = part_at_rest(Part::windscreen);
  for (auto& x : glass.body.position_m) x.x() *= 1.02;
  CHECK(flow(glass).elements == 0);
}

TEST_CASE("a sliding part stops after v squared over two mu g") {
  State state;
  Random random(1);
  const double half_height = 0.5 * part_recipe(Part::lamp).size_m.z;
  spawn_part(state, Part::lamp, {{0, 0, half_height}, {1, 0, 0, 0}}, Vec3(0, 3, 0), Vec3(0), random);
  ContactWorld world = level_road();
  for (int k = 0; k < 180; ++k) advance_debris(state, world, 1.0 / 60);
  REQUIRE(state.pieces.size() == 1);
  const double expected = 9.0 / (2 * material_data(Material::bumper_plastic).friction * 9.81);
  const auto centre = elastic::centre_of_mass_m(state.pieces[0].body);
  CHECK(centre.y() == relative(expected, 0.08));
  CHECK(centre.z() == relative(half_height, 0.02));
}

TEST_CASE("a box with a cut is a hull whose slope is met where it is") {
  Box car;
  car.half_size_m = {2.0, 0.9, 0.6};
  const Vec3 normal = glm::normalize(Vec3(0.6, 0.0, 1.6));
  car.cuts = {{normal, glm::dot(normal, Vec3(0.4, 0.0, 0.6))}};
  car.world_from_box = {{10, 5, 0.8}, glm::angleAxis(1.0, Vec3(0, 0, 1))};
  const auto gap = [&](const Vec3& local) { return gap_to_box(car, car.world_from_box * local); };
  CHECK(gap({1.9, 0.0, 0.5}).gap_m > 0.3);  // Over the bonnet, within the box.
  CHECK(gap({1.9, 0.0, -0.3}).gap_m < -0.05);
  const BoxGap on = gap(Vec3(1.2, 0.3, 0.3) + 0.02 * normal);
  CHECK(on.gap_m == doctest::Approx(0.02));
  CHECK(glm::length(on.normal - car.world_from_box.orientation * normal) < 1e-9);
  CHECK(gap({-1.0, 0.0, 0.7}).gap_m == doctest::Approx(0.1));  // The roof is as it was.
  CHECK(gap({-1.0, 0.0, 0.55}).gap_m == doctest::Approx(-0.05));
}

TEST_CASE("two parts that collide keep their momentum together") {
  State state;
  Random random(1);
  spawn_part(state, Part::barrier_post, {{0, 0, 3}, {1, 0, 0, 0}}, Vec3(0), Vec3(0), random);
  spawn_part(state, Part::barrier_post, {{0.28, 0.05, 3.1}, {1, 0, 0, 0}}, Vec3(-4, 0, 0), Vec3(0), random);
  const Eigen::Vector3d before =
      elastic::momentum_ns(state.pieces[0].body) + elastic::momentum_ns(state.pieces[1].body);
  for (int k = 0; k < 5; ++k) {
    for (auto& p : state.pieces)
      for (auto& x : p.body.position_m) x += p.body.velocity_mps[0] * 0.01;
    exchange_impulses(state.pieces, 0.01);
  }
  const Eigen::Vector3d after = elastic::momentum_ns(state.pieces[0].body) + elastic::momentum_ns(state.pieces[1].body);
  CHECK(elastic::momentum_ns(state.pieces[0].body).x() < -1.0);
  CHECK((after - before).norm() < 1e-10 * before.norm());
}

TEST_CASE("of a part that breaks one of the large pieces keeps the name") {
  State state;
  Random random(1);
  const std::uint32_t id =
      spawn_part(state, Part::ice_slab, {{0, 0, 0.2}, {1, 0, 0, 0}}, Vec3(10.0, 0, -30.0), Vec3(0.3, 0.2, 0), random);
  ContactWorld road = level_road();
  int fractures = 0;
  for (int k = 0; k < 30 && state.pieces.size() < 2; ++k) fractures += advance_debris(state, road, 1.0 / 60).fractures;
  REQUIRE(fractures > 0);
  REQUIRE(state.pieces.size() > 1);
  std::size_t largest = 0, named = 0;
  for (const Piece& piece : state.pieces) {
    largest = std::max(largest, piece.body.elements.size());
    if (piece.id == id) named = piece.body.elements.size();
  }
  CHECK(2 * named > largest);  // The largest of each break, which may break again.
}

TEST_CASE("debris is compressible and its saved bodies lack no stress that keeps a volume") {
  for (int m = 0; m < material_count; ++m)
    CHECK_FALSE(elastic::is_incompressible(material_data(static_cast<Material>(m)).elastic));
}
