// A car's struck parts, the limits of its mounts, and parts that fly off.

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/crash.hpp"
#include "engine/effects/debris/piece.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double speed_mps = 56.0 / 3.6;
/// A front gives 0.66 m at 56 km/h (crash.hpp), which is V/ω.
constexpr double crush_m = 0.66, frequency_radps = speed_mps / crush_m;

/// A car of 1.5 t that runs into a body of `other_kg`, from x < 0 towards the plane x = 0; with one part.
struct Run {
  State state;
  Crash crash;
  CrashReport report;

  Run(const MountedPart& part, double other_kg = INFINITY) {
    crash.point_m = {0, 0, 0.5};
    crash.normal = {-1, 0, 0};
    crash.first.box.world_from_box.position_m = {-2.2, 0, 0.75};
    crash.first.box.half_size_m = {2.2, 0.9, 0.7};
    crash.first.box.velocity_mps = {speed_mps, 0, 0};
    crash.first.mass_kg = 1500.0;
    crash.first.parts = {part};
    crash.second.box.world_from_box.position_m = {2.0, 0, 2.0};
    crash.second.box.half_size_m = {2.0, 20.0, 2.0};
    crash.second.mass_kg = other_kg;
    Random random(1);
    report = debris::crash(state, crash, {}, random);
  }
};

MountedPart lamp_at(double x_m, double strength_n) { return {Part::lamp, {{x_m, 0, 0}, {1, 0, 0, 0}}, strength_n}; }

const double lamp_kg = part_recipe(Part::lamp).mass_kg;
const double peak_n = lamp_kg * speed_mps * frequency_radps;

}  // namespace

TEST_CASE("a mount holds up to the mass times the greatest deceleration of the crush") {
  const Run held(lamp_at(-2.0, 1.05 * peak_n)), torn(lamp_at(-2.0, 0.95 * peak_n));
  CHECK(held.report.torn_off == 0);
  CHECK(held.crash.first.parts.size() == 1);
  CHECK(torn.report.torn_off == 1);
  CHECK(torn.crash.first.parts.empty());
  // Against a car of the same mass each loses half the speed.
  CHECK(Run(lamp_at(-2.0, 0.53 * peak_n), 1500.0).report.torn_off == 0);
  CHECK(Run(lamp_at(-2.0, 0.47 * peak_n), 1500.0).report.torn_off == 1);
}

TEST_CASE("what breaks off is told, and its pieces know whose they are") {
  MountedPart lamp = lamp_at(2.1, INFINITY);
  lamp.mount = Mount::front_right_lamp;
  Run run(lamp);
  CHECK(run.crash.first.torn == bit_of(Mount::front_right_lamp));
  CHECK(run.crash.second.torn == 0);
  REQUIRE_FALSE(run.state.pieces.empty());
  CHECK_FALSE(run.state.pieces.front().origin);  // Of a body that is no vehicle.
  run.crash.first.parts = {lamp};
  run.crash.first.origin = PieceOrigin{12, 4, 7, Mount::front_bumper};
  Random random(1);
  State state;
  debris::crash(state, run.crash, {}, random);
  REQUIRE(state.pieces.size() > 1);
  for (const Piece& piece : state.pieces) CHECK(piece.origin == PieceOrigin{12, 4, 7, Mount::front_right_lamp});
}

TEST_CASE("a part is struck where the crush and its own thickness reach it and no further in") {
  const double reach_m = crush_m + 0.5 * part_recipe(Part::lamp).size_m.x;
  CHECK(Run(lamp_at(2.2 - 0.95 * reach_m, INFINITY)).report.struck == 1);
  CHECK(Run(lamp_at(2.2 - 1.05 * reach_m, INFINITY)).report.struck == 0);
}

TEST_CASE("what is torn off flies with the speed that the car had when its mounts gave way") {
  for (const double share : {0.1, 0.5, 0.9}) {
    CAPTURE(share);
    const Run run(lamp_at(-2.0, share * peak_n));
    REQUIRE(run.state.pieces.size() == 1);
    const elastic::ElasticBody& lamp = run.state.pieces.front().body;
    // V cos ωt at sin ωt = share.
    const double left_mps = speed_mps * std::sqrt(1.0 - share * share);
    CHECK(elastic::momentum_ns(lamp).x() / elastic::total_mass_kg(lamp) == relative(left_mps, 0.02));
    CHECK(run.crash.first.impulse_ns.x == relative(lamp_kg * (speed_mps - left_mps), 0.02));
    CHECK(glm::length(from_eigen(elastic::rigid_motion(lamp).angular_velocity_radps)) < 0.15 * speed_mps * 3.0);
  }
}

TEST_CASE("a struck part goes to the common speed and out with at most what the blow returns") {
  const Run wall(lamp_at(2.1, INFINITY)), car(lamp_at(2.1, INFINITY), 1500.0);
  const auto mean_mps = [](const Run& run) {
    Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
    double mass = 0.0;
    for (const Piece& p : run.state.pieces)
      momentum += elastic::momentum_ns(p.body), mass += elastic::total_mass_kg(p.body);
    return from_eigen(Eigen::Vector3d(momentum / mass));
  };
  CHECK(std::abs(mean_mps(wall).x) < 0.01);
  CHECK(mean_mps(car).x == relative(0.5 * speed_mps, 0.01));
  const double returned_mps = material_data(Material::bumper_plastic).restitution * speed_mps;
  for (const Run* run : {&wall, &car}) {
    const Vec3 out = mean_mps(*run);
    CHECK(std::hypot(out.y, out.z) < 1.001 * returned_mps);
    CHECK(out.z > 0.1);  // Rather up than down.
  }
}

TEST_CASE("a car's parts lie in its hull and hold as the rules ask") {
  const Vec3 half(2.4, 0.9, 0.7);
  int doors = 0, lamps = 0, bumpers = 0;
  for (const MountedPart& mounted : passenger_car_parts(half)) {
    const PartRecipe& recipe = part_recipe(mounted.part);
    const Vec3 place = mounted.box_from_part.position_m;
    if (mounted.part != Part::windscreen)
      for (int c = 0; c < 3; ++c) CHECK(std::abs(place[c]) + 0.5 * recipe.size_m[c] < half[c] + 1e-9);
    doors += mounted.part == Part::door;
    lamps += mounted.part == Part::lamp;
    bumpers += mounted.part == Part::bumper;
    if (mounted.part == Part::door) CHECK(mounted.mount_strength_n == 11e3);  // UN Regulation 11.
    if (mounted.part == Part::lamp || mounted.part == Part::bumper)
      CHECK(mounted.mount_strength_n == doctest::Approx(30.0 * 9.81 * recipe.mass_kg));
  }
  Mounts all = 0;
  for (const MountedPart& mounted : passenger_car_parts(half)) {
    CHECK((all & bit_of(mounted.mount)) == 0);
    all |= bit_of(mounted.mount);
  }
  CHECK(all == (1u << mount_count) - 1u);
  CHECK(doors == 4);
  CHECK(lamps == 4);
  CHECK(bumpers == 2);
  int short_doors = 0;
  for (const MountedPart& mounted : passenger_car_parts({1.8, 0.8, 0.7})) short_doors += mounted.part == Part::door;
  CHECK(short_doors == 2);
}
