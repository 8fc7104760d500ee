/// Laminated panes star and hold; tempered ones crumble.

#include <cstdint>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/effects/debris/crash.hpp"
#include "engine/effects/debris/fracture.hpp"
#include "engine/effects/debris/laminate.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/crashes.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

/// Half a second of a pane thrown flat at a wall or a post of this width, without ground.
State thrown_at_wall(Part part, double width_m, std::uint64_t seed) {
  State state;
  Random random(seed);
  const Quat turned = glm::angleAxis(std::numbers::pi / 2.0, Vec3(0, 0, 1));
  const Quat flat = part == Part::side_window ? turned : Quat(1, 0, 0, 0);
  spawn_part(state, part, {{0.65, 0, 1.0}, flat}, Vec3(-crash_speed_mps, 0, 0), Vec3(0), random);
  ContactWorld world;
  Box wall;
  wall.half_size_m = {0.5, 0.5 * width_m, 5.0};
  world.boxes = {wall};
  for (int k = 0; k < 30; ++k) advance_debris(state, world, 1.0 / 60);
  return state;
}

double mass_of_all_kg(const State& state) {
  double mass_kg = 0.0;
  for (const Piece& piece : state.pieces) mass_kg += elastic::total_mass_kg(piece.body);
  for (const Shard& shard : state.shards) mass_kg += shard.mass_kg;
  return mass_kg;
}

/// A car whose nose meets a pane in its mount, 0.1 m behind its front.
CrashReport crash_at_pane(Part part, Mount mount, State& state, CrashBody& car) {
  Random random(1);
  Crash crash = into_barrier(crash_speed_mps);
  crash.first.parts = {{part, {{2.1, 0.0, -0.2}, {1, 0, 0, 0}}, 40e3, mount}};
  const CrashReport report = debris::crash(state, crash, level_road(), random);
  car = crash.first;
  return report;
}

}  // namespace

TEST_CASE("a windscreen that is thrown at a wall at 70 kilometres per hour cracks through and stays in one piece") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    const State state = thrown_at_wall(Part::windscreen, 10.0, seed);
    REQUIRE(state.pieces.size() == 1);
    CHECK(state.shards.empty());
    CHECK(state.pieces.front().cracks.size() > 20);
    for (const FaceCrack& crack : state.pieces.front().cracks) CHECK(crack.reach == cracked_through);
    CHECK(mass_of_all_kg(state) == relative(part_recipe(Part::windscreen).mass_kg, 1e-6));
  }
}

TEST_CASE("a cracked windscreen is as stiff as its film and a whole one as its glass") {
  Piece pane = part_at_rest(Part::windscreen);
  const double glass_pa = pane.material.elastic.young_modulus_pa;
  FractureResult none;
  CHECK(take_cracks(pane, none) == 0.0);
  CHECK(pane.body.material.young_modulus_pa == glass_pa);
  for (auto& x : pane.body.position_m) x.y() *= 1.0001;
  const double stored_j = elastic::elastic_energy_j(pane.body);
  FractureResult cracked;
  cracked.cracks = {{0, 1, cracked_through}};
  CHECK(take_cracks(pane, cracked) == relative((1.0 - film_share) * stored_j, 1e-9));
  CHECK(pane.body.material.young_modulus_pa == relative(film_share * glass_pa, 1e-12));
  CHECK(elastic::elastic_energy_j(pane.body) == relative(film_share * stored_j, 1e-9));
}

TEST_CASE("a side window that breaks anywhere crumbles everywhere and one below its strength holds") {
  Piece window = part_at_rest(Part::side_window);
  const double strength_pa = window.material.strength_pa;
  const Eigen::Matrix3d along = Eigen::Vector3d::UnitX() * Eigen::Vector3d::UnitX().transpose();
  // Glass that is not tempered has three eighths of this strength.
  window.body.step_stress_pa.assign(window.body.elements.size(), 0.9 * strength_pa * along);
  CHECK(fracture(window).opened_faces == 0);
  window.body.step_stress_pa[10] = 2.0 * strength_pa * along;
  const FractureResult broken = fracture(window);
  CHECK(broken.pieces.size() > 80);
  CHECK(broken.cracked_j == 0.0);
  for (const Piece& piece : broken.pieces)
    for (const int splinter : piece.splinter) CHECK(splinter == piece.splinter.front());
}

TEST_CASE("a side window that is thrown at a post is only shards with all of its mass") {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    CAPTURE(seed);
    const State state = thrown_at_wall(Part::side_window, 0.2, seed);
    CHECK(state.pieces.empty());
    CHECK(state.shards.size() > 80);
    CHECK(mass_of_all_kg(state) == relative(part_recipe(Part::side_window).mass_kg, 1e-6));
    for (const Shard& shard : state.shards) CHECK(shard.size_m < 0.04);
  }
}

TEST_CASE("a windscreen that the crush reaches stars in its frame and loses a few splinters") {
  State state;
  CrashBody car;
  const CrashReport report = crash_at_pane(Part::windscreen, Mount::windscreen, state, car);
  CHECK(report.starred == 1);
  CHECK(report.struck == 0);
  CHECK(car.parts.size() == 1);
  CHECK(car.torn == 0);
  CHECK(state.pieces.empty());
  CHECK(state.shards.size() == 8);
  CHECK(mass_of_all_kg(state) < 0.01 * part_recipe(Part::windscreen).mass_kg);
  Vec3 momentum_ns = car.impulse_ns;
  for (const Shard& shard : state.shards) momentum_ns += shard.mass_kg * shard.velocity_mps;
  CHECK(momentum_ns.x == relative(mass_of_all_kg(state) * crash_speed_mps, 1e-6));
}

TEST_CASE("a side window crumbles with the door that it runs in and stays with one that holds") {
  for (const bool hit : {true, false}) {
    CAPTURE(hit);
    State state;
    Random random(1);
    Crash crash = into_barrier(crash_speed_mps);
    const Vec3 door_m(hit ? 2.1 : 0.0, 0.8, -0.1), window_m(0.0, 0.88, 0.3);
    crash.first.parts = {{Part::door, {door_m, {1, 0, 0, 0}}, 11e3, Mount::front_left_door},
                         {Part::side_window, {window_m, {1, 0, 0, 0}}, 11e3, Mount::front_left_window}};
    debris::crash(state, crash, level_road(), random);
    CHECK(crash.first.parts.size() == (hit ? 0 : 2));
    CHECK((state.shards.size() > 80) == hit);
    CHECK(crash.first.torn == (hit ? bit_of(Mount::front_left_door) | bit_of(Mount::front_left_window) : 0));
  }
}
