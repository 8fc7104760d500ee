#include "engine/effects/debris/crash.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/contacts.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/crashes.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/engine/physics/elastic/element_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

double carried_mass_kg(const CrashBody& body) {
  double mass = 0.0;
  for (const auto& m : body.parts) mass += part_recipe(m.part).mass_kg;
  return mass;
}

}  // namespace

TEST_CASE("a crash at 70 kilometres per hour throws parts and one at walking pace none") {
  for (const double speed : {crash_speed_mps, 1.0}) {
    State state;
    Random random(1);
    Crash crash = into_barrier(speed);
    const auto parts = crash.first.parts.size();
    const CrashReport report = debris::crash(state, crash, level_road(), random);
    CHECK(report.closing_speed_mps == doctest::Approx(speed));
    CHECK(crash.first.parts.size() + static_cast<std::size_t>(report.struck + report.torn_off) == parts);
    CHECK(report.pieces.empty() == (speed < 2.0));
    if (speed < 2.0) continue;
    CHECK(report.struck >= 3);            // Bumper and headlamps.
    CHECK(report.fragments >= 8);         // And in more than one piece.
    CHECK(crash.first.parts.size() > 3);  // Doors and rear stay.
  }
}

TEST_CASE("what a crash throws keeps mass and momentum and gets no energy") {
  State state;
  Random random(7);
  Crash crash = into_barrier(crash_speed_mps);
  const double carried = carried_mass_kg(crash.first);
  const CrashReport report = debris::crash(state, crash, level_road(), random);
  double mass = 0.0, energy = 0.0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  for (const Piece& p : state.pieces) {
    mass += elastic::total_mass_kg(p.body);
    momentum += elastic::momentum_ns(p.body);
    energy += elastic::kinetic_energy_j(p.body);
    CHECK(elastic::least_determinant_of(p.body) > 0.9);
  }
  CHECK(mass == relative(carried - carried_mass_kg(crash.first), 0.02));
  const Vec3 before(mass * crash_speed_mps, 0, 0);
  const Vec3 after = from_eigen(momentum) + crash.first.impulse_ns;
  CHECK(glm::length(after - before) < 0.02 * before.x);
  CHECK(energy < 0.5 * mass * report.closing_speed_mps * report.closing_speed_mps);
}

TEST_CASE("two cars that meet head on both lose their bumpers") {
  State state;
  Random random(1);
  Crash crash = into_barrier(crash_speed_mps);
  crash.second = car_at(2.2, 0.0);
  crash.second.box.world_from_box.orientation = glm::angleAxis(3.14159265358979, Vec3(0, 0, 1));
  crash.second.box.velocity_mps = {-crash_speed_mps, 0, 0};
  const CrashReport report = debris::crash(state, crash, level_road(), random);
  CHECK(report.closing_speed_mps == doctest::Approx(2 * crash_speed_mps));
  for (const CrashBody* body : {&crash.first, &crash.second})
    CHECK(std::ranges::none_of(
        body->parts, [](const MountedPart& m) { return m.part == Part::bumper && m.box_from_part.position_m.x > 0; }));
}

TEST_CASE("the same crash throws the same debris") {
  const auto sum = [] {
    State state;
    Random random(5);
    Crash crash = into_barrier(crash_speed_mps);
    debris::crash(state, crash, level_road(), random);
    double total = 0.0;
    for (const Piece& p : state.pieces)
      for (const auto& v : p.body.velocity_mps) total += v.x() + 2 * v.y() + 3 * v.z();
    return total;
  };
  const double first = sum();
  CHECK(first != 0.0);  // It throws some.
  CHECK(first == sum());
}

TEST_CASE("everything but a laminated pane falls apart in the crush of a crash at 70 kilometres per hour") {
  for (int i = 0; i < part_count; ++i)
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
      if (part_recipe(static_cast<Part>(i)).breakage == Breakage::holds) continue;
      State state;
      Random random(seed);
      Crash crash = into_barrier(crash_speed_mps);
      crash.first.parts = {{static_cast<Part>(i), {{2.1, 0.0, -0.2}, {1, 0, 0, 0}}, 100.0}};
      const CrashReport report = debris::crash(state, crash, level_road(), random);
      INFO("part " << i << ", seed " << seed);
      CHECK(report.struck == 1);
      CHECK(report.fragments >= 2);
    }
}

TEST_CASE("concrete and ice break at the blow when thrown flat at a wall at 70 kilometres per hour") {
  for (const Part part : {Part::barrier_post, Part::ice_slab}) {
    State state;
    Random random(3);
    const double half = 0.5 * part_recipe(part).size_m.x;
    spawn_part(state, part, {{half + 0.6, 0, 1.0}, {1, 0, 0, 0}}, Vec3(-crash_speed_mps, 0, 0), Vec3(0), random);
    ContactWorld world;  // No ground: the wall alone breaks it.
    Box wall;
    wall.half_size_m = {0.5, 5.0, 5.0};
    world.boxes = {wall};
    const double energy = 0.5 * part_recipe(part).mass_kg * crash_speed_mps * crash_speed_mps;
    for (int k = 0; k < 12; ++k) advance_debris(state, world, 1.0 / 60);
    INFO("part ", static_cast<int>(part), ": ", state.pieces.size(), " pieces, ", state.shards.size(), " shards");
    CHECK(state.pieces.size() + state.shards.size() > 2);
    double mass = 0.0, left = 0.0;
    for (const Piece& p : state.pieces) {
      mass += elastic::total_mass_kg(p.body);
      left += elastic::kinetic_energy_j(p.body) + elastic::elastic_energy_j(p.body);
      CHECK(elastic::least_determinant_of(p.body) > 0.0);
    }
    for (const Shard& s : state.shards) {
      mass += s.mass_kg;
      left += 0.5 * s.mass_kg * glm::dot(s.velocity_mps, s.velocity_mps);
    }
    CHECK(mass == relative(part_recipe(part).mass_kg, 0.02));
    CHECK(left < 1.05 * energy);  // And a fall of 0.2 s.
  }
}

TEST_CASE("a steel door thrown at a wall keeps a dent") {
  State state;
  Random random(3);
  spawn_part(state, Part::door, {{1.3, 0, 1.0}, {1, 0, 0, 0}}, Vec3(-crash_speed_mps, 0, 0), Vec3(0), random);
  ContactWorld world;
  Box wall;
  wall.half_size_m = {0.5, 5.0, 5.0};
  world.boxes = {wall};
  for (int k = 0; k < 12; ++k) advance_debris(state, world, 1.0 / 60);
  REQUIRE_FALSE(state.pieces.empty());
  double most = 0.0;
  for (const double strain : state.pieces[0].plastic_strain) most = std::max(most, strain);
  CHECK(most > 0.001);
}
