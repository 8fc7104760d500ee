// Rigid shards of glass, and debris at rest on the road.

#include "engine/effects/debris/shards.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <Eigen/Geometry>
#include <glm/geometric.hpp>

#include "engine/effects/debris/air_force.hpp"
#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/math/gravity.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/all_keyframes.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double shard_step_s = 0.001;

State with_shard(const Vec3& position_m, const Vec3& velocity_mps) {
  State state;
  Shard shard;
  shard.position_m = position_m;
  shard.velocity_mps = velocity_mps;
  shard.mass_kg = 0.01;
  state.shards.push_back(shard);
  return state;
}

/// A cube of glass.
State with_crumb(double edge_m, const Vec3& position_m, const Vec3& velocity_mps) {
  State state = with_shard(position_m, velocity_mps);
  Shard& crumb = state.shards.front();
  crumb.size_m = edge_m;
  crumb.mass_kg = 2500.0 * edge_m * edge_m * edge_m;
  crumb.shade_m2 = 1.5 * edge_m * edge_m;
  return state;
}

/// Where a shard meets the level road, along x.
double lands_m(State state, const Vec3& wind_mps, double step_s) {
  ContactWorld road = level_road();
  road.wind_mps = wind_mps;
  while (state.shards[0].position_m.z > 0.0) advance_shards(state, road, step_s);
  return state.shards[0].position_m.x;
}

/// The same of the law dv/dt = -g - k |v - w| (v - w), k = 0.5 rho C shade / m, by the midpoint rule.
double lands_by_law_m(const Shard& shard, const Vec3& wind_mps) {
  constexpr double step_s = 1e-5;
  const double per_m = 0.5 * air_density_kgpm3 * tumbling_coefficient * shard.shade_m2 / shard.mass_kg;
  const auto gains = [&](const Vec3& v) {
    return Vec3(0.0, 0.0, -gravity_mps2) - per_m * glm::length(v - wind_mps) * (v - wind_mps);
  };
  Vec3 place = shard.position_m, v = shard.velocity_mps;
  while (place.z > 0.0) {
    const Vec3 middle = v + 0.5 * step_s * gains(v);
    place += step_s * middle;
    v += step_s * gains(middle);
  }
  return place.x;
}

}  // namespace

TEST_CASE("a crumb of glass of 5 mm thrown at 15 m/s lands short of a vacuum's parabola by what the air's law gives") {
  for (const double edge_m : {0.005, 0.01}) {
    const State crumb = with_crumb(edge_m, {0, 0, 1.2}, {15, 0, 0});
    State in_vacuum = crumb;
    in_vacuum.shards[0].shade_m2 = 0.0;
    const double short_m = lands_m(in_vacuum, Vec3(0.0), 1e-4) - lands_m(crumb, Vec3(0.0), 1e-4);
    CHECK(short_m ==
          relative(lands_by_law_m(in_vacuum.shards[0], Vec3(0.0)) - lands_by_law_m(crumb.shards[0], Vec3(0.0)), 0.01));
    // At the step of a drive.
    CHECK(lands_m(crumb, Vec3(0.0), 1.0 / 120.0) == relative(lands_by_law_m(crumb.shards[0], Vec3(0.0)), 0.03));
  }
  CHECK(15.0 * std::sqrt(2.0 * 1.2 / 9.81) -
            lands_by_law_m(with_crumb(0.005, {0, 0, 1.2}, {15, 0, 0}).shards[0], Vec3(0.0)) >
        1.2);
}

TEST_CASE("the scene's wind carries a falling crumb along and one that lies on the road stays") {
  const Vec3 wind_mps(20, 0, 0);
  const State falls = with_crumb(0.005, {0, 0, 2.5}, {0, 0, 0});
  const double carried_m = lands_by_law_m(falls.shards[0], wind_mps);
  CHECK(carried_m > 2.0);
  CHECK(lands_m(falls, wind_mps, 1e-4) == relative(carried_m, 0.01));
  State lies = with_crumb(0.005, {0, 0, 0}, {0, 0, 0});
  ContactWorld road = level_road();
  road.wind_mps = wind_mps;
  for (int k = 0; k < 1000; ++k) advance_shards(lies, road, shard_step_s);
  CHECK(lies.shards[0].position_m == Vec3(0.0));
}

TEST_CASE("air that goes along with a shard leaves it alone, and no step is so long that it throws one back") {
  CHECK(slowed_by_air_mps({0, 0, 0}, 1e-4, 1e-3, 1.0) == Vec3(0.0));
  const Vec3 left_mps = slowed_by_air_mps({30, 0, 0}, 1.0, 1e-3, 1.0);
  CHECK(left_mps.x > 0.0);
  CHECK(left_mps.x < 0.01);
}

TEST_CASE("a shard and a piece whose numbers go bad are counted, and what is told of the debris stays finite") {
  State state = with_shard({0, 0, 5}, {0, 0, 0});
  state.shards.push_back(state.shards.front());
  state.shards[0].velocity_mps.x = NAN;
  state.shards[1].angular_velocity_radps.y = INFINITY;
  state.shards.push_back(with_shard({1, 0, 5}, {0, 0, 0}).shards.front());
  Random random(1);
  spawn_part(state, Part::windscreen, RigidTransform{}, Vec3(0.0), Vec3(0.0), random);
  state.pieces.front().body.velocity_mps.front().z() = NAN;
  state.pieces.front().asleep = true;  // Skipped by every step.
  ContactWorld road = level_road();
  advance_debris(state, road, shard_step_s);
  CHECK(state.shards.size() == 1);
  CHECK(state.bad_numbers == 3);
  for (const auto& velocity_mps : state.pieces.front().body.velocity_mps) CHECK(velocity_mps.allFinite());
  CHECK(effect_keyframes(state).size() == 2);
}

TEST_CASE("a shard falls freely and a fifth of its speed comes back from the road") {
  State state = with_shard({0, 0, 5}, {2, 0, 0});
  const ContactWorld road = level_road();
  for (int k = 0; k < 500; ++k) advance_shards(state, road, shard_step_s);
  CHECK(state.shards[0].velocity_mps.z == doctest::Approx(-9.81 * 0.5));
  CHECK(state.shards[0].velocity_mps.x == 2.0);
  CHECK(state.shards[0].position_m.x == doctest::Approx(1.0));
  double closing_mps = 0.0;
  while (state.shards[0].velocity_mps.z <= 0.0) {
    closing_mps = -state.shards[0].velocity_mps.z;
    advance_shards(state, road, shard_step_s);
  }
  CHECK(state.shards[0].velocity_mps.z == relative(0.2 * closing_mps, 0.02));
  CHECK(state.shards[0].velocity_mps.x == 0.0);  // Friction of 0.4 times 1.2 times the impulse exceeds its momentum.
}

TEST_CASE("a shard that grazes the road loses Coulomb's share and comes to rest on it") {
  State state = with_shard({0, 0, 1e-6}, {20, 0, -3});
  advance_shards(state, level_road(), shard_step_s);
  CHECK(state.shards[0].velocity_mps.x == relative(20.0 - 0.4 * 1.2 * 3.0, 0.005));
  for (int k = 0; k < 10'000; ++k) advance_shards(state, level_road(), shard_step_s);
  CHECK(state.shards[0].velocity_mps == Vec3(0.0));
  CHECK(state.shards[0].position_m.z == 0.0);
}

TEST_CASE("a shard bounces off a vehicle that moves and leaves it on its outside") {
  State state = with_shard({0.1, 0, 1}, {0, 0, 0});
  ContactWorld world;
  Box car;
  car.half_size_m = {1.0, 1.0, 1.0};
  car.world_from_box.position_m = {-0.95, 0, 1};  // Its front five centimetres short of it.
  car.velocity_mps = {10, 0, 0};
  world.boxes = {car};
  for (int k = 0; k < 20; ++k) {
    advance_shards(state, world, shard_step_s);
    world.boxes[0].world_from_box.position_m.x += 10.0 * shard_step_s;
  }
  CHECK(state.shards[0].velocity_mps.x == doctest::Approx(12.0));
  CHECK(state.shards[0].position_m.x > world.boxes[0].world_from_box.position_m.x + 1.0);
}

TEST_CASE("one splinter of glass is a shard with its mass and motion and turns at most at thirty radians a second") {
  Piece glass = part_at_rest(Part::side_window);
  CHECK_FALSE(is_shard(glass));
  for (int& splinter : glass.splinter) splinter = 3;
  CHECK(is_shard(glass));
  for (const double rate : {10.0, 300.0}) {
    for (int i = 0; i < glass.body.node_count(); ++i) {
      const Eigen::Vector3d arm = glass.body.position_m[i] - elastic::centre_of_mass_m(glass.body);
      glass.body.velocity_mps[i] = Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(0, 0, rate).cross(arm);
    }
    const Shard shard = shard_of(glass);
    CHECK(shard.mass_kg == relative(part_recipe(Part::side_window).mass_kg, 0.001));
    CHECK(shard.shade_m2 == relative(0.5 * 0.8 * 0.4, 0.001));
    CHECK(glm::length(shard.velocity_mps - Vec3(1, 2, 3)) < 1e-9);
    CHECK(shard.angular_velocity_radps.z == doctest::Approx(std::min(rate, 30.0)));
  }
  Piece bumper = part_at_rest(Part::bumper);
  for (int& splinter : bumper.splinter) splinter = 0;
  CHECK_FALSE(is_shard(bumper));  // Plastic flies on as an elastic piece.
  Piece windscreen = part_at_rest(Part::windscreen);
  for (int& splinter : windscreen.splinter) splinter = 0;
  CHECK_FALSE(is_shard(windscreen));  // Its film holds it.
}

TEST_CASE("the shards' keyframe sleeps once all of them do") {
  std::vector<Shard> shards(2);
  CHECK(keyframe_of(shards).asleep);
  shards[0].velocity_mps = {1, 0, 0};
  CHECK_FALSE(keyframe_of(shards).asleep);
  shards[0].velocity_mps = {0, 0, 0};
  shards[1].velocity_mps = {1, 0, 0};
  CHECK_FALSE(keyframe_of(shards).asleep);
  CHECK(keyframe_of(shards).vertices_m.size() == 6);
}

TEST_CASE("a wheel meets a slab that lies flat and nothing thinner than a centimetre") {
  State state;
  Piece slab = part_at_rest(Part::ice_slab);
  const double top_m = 2.0 + 0.5 * part_recipe(Part::ice_slab).size_m.z;
  state.pieces = {slab};
  REQUIRE(highest_debris_m(state, 0.0, 0.0, 0.2));
  CHECK(*highest_debris_m(state, 0.0, 0.0, 0.2) == doctest::Approx(top_m));
  CHECK_FALSE(highest_debris_m(state, 1.3, 0.0, 0.2));
  for (auto& x : state.pieces[0].body.position_m) x.z() *= 0.1;  // 8 mm.
  CHECK_FALSE(highest_debris_m(state, 0.0, 0.0, 0.2));
}

TEST_CASE("a shard that slides on the road stops after v squared over two mu g, on a slippery one that much later") {
  for (const double factor : {1.0, 0.5, 0.25}) {
    CAPTURE(factor);
    State state = with_shard({0, 0, 0}, {5, 0, 0});
    ContactWorld road;
    road.ground = [factor](double, double) {
      GroundPoint point;
      point.friction_factor = factor;
      return point;
    };
    for (int k = 0; k < 8000; ++k) advance_shards(state, road, shard_step_s);
    CHECK(state.shards[0].velocity_mps == Vec3(0.0));
    CHECK(state.shards[0].position_m.x == relative(25.0 / (2.0 * 0.4 * factor * 9.81), 0.01));
  }
}

TEST_CASE("a shard that touches the road gently does not come back from it") {
  State state = with_shard({0, 0, 1e-6}, {3, 0, -0.4});
  advance_shards(state, level_road(), shard_step_s);
  CHECK(std::abs(state.shards[0].velocity_mps.z) < 1e-12);
  CHECK(state.shards[0].velocity_mps.x > 2.0);
}
