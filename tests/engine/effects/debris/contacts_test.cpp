// A corner that pokes into the middle of another piece's face, and where a contact is found.

#include "engine/effects/debris/contacts.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <Eigen/LU>
#include <glm/geometric.hpp>

#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double step_s = 0.01, depth_m = 0.001;
const Eigen::Vector3d corner_m(0.35, 0.3, -depth_m);

/// A concrete corner, with this velocity, a millimetre below the face of a rubber wedge at rest.
std::vector<Piece> corner_in_face(const Eigen::Vector3d& velocity_mps) {
  std::vector<Piece> pieces{tetrahedron({{{0, 0, 0.5}, {1, 0, 0.5}, {0, 1, 0.5}, corner_m}}, Material::concrete),
                            tetrahedron({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.3, 0.3, -1}}}, Material::rubber)};
  for (auto& v : pieces[0].body.velocity_mps) v = velocity_mps;
  return pieces;
}

/// Of the corner against the wedge's surface where it touches.
Eigen::Vector3d relative_mps(const std::vector<Piece>& pieces) {
  const auto& a = pieces[0].body;
  const auto& b = pieces[1].body;
  const auto& nodes = b.elements[0].nodes;
  Eigen::Matrix3d edges;
  for (int c = 0; c < 3; ++c) edges.col(c) = b.position_m[nodes[c + 1]] - b.position_m[nodes[0]];
  const Eigen::Vector3d weight = edges.inverse() * (corner_m - b.position_m[nodes[0]]);
  Eigen::Vector3d surface = (1.0 - weight.sum()) * b.velocity_mps[nodes[0]];
  for (int c = 0; c < 3; ++c) surface += weight[c] * b.velocity_mps[nodes[c + 1]];
  return a.velocity_mps[a.body_node_of_mesh_node[3]] - surface;
}

Eigen::Vector3d momentum(const std::vector<Piece>& pieces) {
  return elastic::momentum_ns(pieces[0].body) + elastic::momentum_ns(pieces[1].body);
}

}  // namespace

TEST_CASE("a corner that meets the middle of a face leaves it at a fifth of its depth in a step and no faster") {
  auto pieces = corner_in_face({0, 0, -5.0});
  const Eigen::Vector3d before = momentum(pieces);
  exchange_impulses(pieces, step_s);
  CHECK(relative_mps(pieces).z() == relative(0.2 * depth_m / step_s, 1e-9));
  CHECK((momentum(pieces) - before).norm() < 1e-12 * before.norm());
  // A corner that leaves faster is not held.
  auto leaving = corner_in_face({0, 0, 0.1});
  exchange_impulses(leaving, step_s);
  CHECK(relative_mps(leaving).z() == 0.1);
}

TEST_CASE("a corner that slides over a face loses the mean friction's share of the blow and stops where that is more") {
  const double friction = 0.5 * (material_data(Material::concrete).friction + material_data(Material::rubber).friction);
  auto fast = corner_in_face({30.0, 0, -5.0});
  exchange_impulses(fast, step_s);
  CHECK(relative_mps(fast).x() == relative(30.0 - friction * 5.02, 1e-9));
  auto slow = corner_in_face({0, 1.0, -5.0});
  exchange_impulses(slow, step_s);
  CHECK(std::abs(relative_mps(slow).y()) < 1e-9);
}

TEST_CASE("a sleeper is woken by a blow and two sleepers leave each other alone") {
  auto pieces = corner_in_face({0, 0, -5.0});
  pieces[1].asleep = true;
  exchange_impulses(pieces, step_s);
  CHECK_FALSE(pieces[1].asleep);
  auto asleep = corner_in_face({0, 0, -5.0});
  asleep[0].asleep = asleep[1].asleep = true;
  exchange_impulses(asleep, step_s);
  CHECK(asleep[1].asleep);
  CHECK(relative_mps(asleep).z() == -5.0);
}

TEST_CASE("the ground is met where its slope lies with its own friction and a box where its velocity has taken it") {
  Piece lamp = part_at_rest(Part::lamp);  // Its lowest corners 1.91 m up.
  for (auto& x : lamp.body.position_m) x.z() -= 1.91;
  const Vec3 slope = glm::normalize(Vec3(-0.3, 0.0, 1.0));
  ContactWorld world;
  world.ground = [&](double x_m, double) { return GroundPoint{0.3 * x_m, slope, 0.5}; };
  const auto found = find_contacts(lamp, world, step_s);
  REQUIRE(!found.empty());
  for (const FoundContact& f : found) {
    const Eigen::Vector3d& at = lamp.body.position_m[f.contact.node];
    CHECK(f.box == -1);
    CHECK(f.contact.gap_m == doctest::Approx(glm::dot(from_eigen(at), slope)));
    CHECK(f.contact.friction == doctest::Approx(0.5 * lamp.material.friction));
    CHECK(glm::length(from_eigen(f.contact.normal) - slope) < 1e-12);
  }
  // A wall that comes at 10 m/s and turns; after 20 ms it is 20 cm nearer.
  Box wall;
  wall.half_size_m = {0.5, 5.0, 5.0};
  wall.world_from_box.position_m = {0.85, 0.0, 1.0};
  wall.velocity_mps = {-10.0, 0.0, 0.0};
  wall.angular_velocity_radps = {0.0, 0.0, 0.2};
  wall.friction = 0.3;
  ContactWorld other;
  other.boxes = {wall};
  CHECK(find_contacts(lamp, other, 0.001).empty());
  const auto later = find_contacts(lamp, other, 0.001, 0.027);
  REQUIRE(!later.empty());
  for (const FoundContact& f : later) {
    const Eigen::Vector3d& at = lamp.body.position_m[f.contact.node];
    CHECK(f.box == 0);
    CHECK(f.contact.gap_m == doctest::Approx(0.35 - 0.27 - at.x()));
    CHECK(f.contact.normal.x() == doctest::Approx(-1.0));
    CHECK(f.contact.friction == doctest::Approx(0.3));
    CHECK(f.contact.surface_velocity_mps.y() == doctest::Approx(0.2 * (at.x() + 0.27 - 0.85)));
    CHECK(f.contact.surface_velocity_mps.x() == doctest::Approx(-10.0 - 0.2 * at.y()));
  }
}
