/// What must not break does not.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "engine/effects/debris/debris_state.hpp"
#include "tests/engine/effects/debris/pieces.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double tick_s = 1.0 / 60.0;
constexpr std::uint64_t seed_count = 3;

/// A part whose lowest node is `height_m` above the road and that falls with `falling_mps`.
State part_above(Part part, double height_m, double falling_mps, std::uint64_t seed) {
  double lowest_m = INFINITY;
  for (const auto& x : part_at_rest(part, seed).body.position_m) lowest_m = std::min(lowest_m, x.z() - 2.0);
  State state;
  Random random(seed);
  spawn_part(state, part, {{0, 0, height_m - lowest_m}, {1, 0, 0, 0}}, {0, 0, -falling_mps}, Vec3(0), random);
  return state;
}

/// Faces that open within two seconds.
int opened_faces(State& state, ContactWorld& world) {
  int faces = 0;
  for (int k = 0; k < 120; ++k) {
    faces += advance_debris(state, world, tick_s).fractures;
    for (Box& box : world.boxes) box.world_from_box.position_m += tick_s * box.velocity_mps;
  }
  return faces;
}

}  // namespace

TEST_CASE("nothing breaks that falls as low as its part may fall") {
  struct Fall {
    Part part;
    double height_m, falling_mps;
  };
  for (const Fall& fall :
       {Fall{Part::ice_slab, 0.05, 0.0}, Fall{Part::windscreen, 0.0, 1.0}, Fall{Part::windscreen, 0.5, 0.0},
        Fall{Part::barrier_post, 0.05, 0.0}, Fall{Part::bumper, 0.85, 0.0}, Fall{Part::door, 0.55, 0.0}})
    for (std::uint64_t seed = 1; seed <= seed_count; ++seed) {
      CAPTURE(static_cast<int>(fall.part));
      CAPTURE(fall.height_m);
      CAPTURE(seed);
      State state = part_above(fall.part, fall.height_m, fall.falling_mps, seed);
      ContactWorld world = level_road();
      CHECK(opened_faces(state, world) == 0);
      CHECK(state.pieces.size() == 1);
      CHECK(state.shards.empty());
    }
}

TEST_CASE("a slab of ice that falls from a lorry's height breaks") {
  for (std::uint64_t seed = 1; seed <= seed_count; ++seed) {
    State state = part_above(Part::ice_slab, 3.5, 0.0, seed);
    ContactWorld world = level_road();
    CHECK(opened_faces(state, world) > 0);
  }
}

TEST_CASE("a cone that a slow wheel pushes stays in one piece") {
  for (std::uint64_t seed = 1; seed <= seed_count; ++seed) {
    CAPTURE(seed);
    State state = part_above(Part::traffic_cone, 0.0, 0.0, seed);
    ContactWorld world = level_road();
    Box wheel;
    wheel.half_size_m = {0.3, 0.1, 0.3};
    wheel.world_from_box.position_m = {-0.8, 0.0, 0.3};
    wheel.velocity_mps = {0.5, 0.0, 0.0};
    world.boxes = {wheel};
    CHECK(opened_faces(state, world) == 0);
    REQUIRE(state.pieces.size() == 1);
    double middle_m = 0.0;
    for (const auto& x : state.pieces[0].body.position_m) middle_m += x.x() / state.pieces[0].body.node_count();
    CHECK(middle_m > 0.2);  // It was pushed.
  }
}
