// The air on debris: forces of flat plates, and how far they carry sheets of ice.

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <Eigen/Geometry>

#include "engine/effects/debris/air_force.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/pieces.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::debris;

namespace {

constexpr double quarter_turn = 0.5 * std::numbers::pi, whole_m = 0.08;

/// A sheet of roof ice that moves along x, its front tilted up by `tilt_rad`: at 90 degrees square to its way.
Piece sheet(double thickness_m, double tilt_rad, double speed_mps) {
  Random random(1);
  return make_part(Part::ice_slab, {{0, 0, 20}, glm::angleAxis(-tilt_rad, Vec3(0, 1, 0))}, Vec3(speed_mps, 0, 0),
                   Vec3(0), random, thickness_m / whole_m);
}

struct Load {
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero(), moment_nm = Eigen::Vector3d::Zero();
};

Load load_of(const Piece& piece) {
  Load load;
  const Eigen::Vector3d centre = elastic::centre_of_mass_m(piece.body);
  for (int i = 0; i < piece.body.node_count(); ++i) {
    load.force_n += piece.body.force_n[i];
    load.moment_nm += (piece.body.position_m[i] - centre).cross(piece.body.force_n[i]);
  }
  return load;
}

/// By how much less than without air a sheet has come along after 0.9 s, high above the road.
double drift_m(double thickness_m, double tilt_rad) {
  State state;
  Random random(1);
  spawn_part(state, Part::ice_slab, {{0, 0, 20}, glm::angleAxis(-tilt_rad, Vec3(0, 1, 0))}, Vec3(25, 0, 0), Vec3(0),
             random, thickness_m / whole_m);
  ContactWorld world = level_road();
  for (int k = 0; k < 54; ++k) advance_debris(state, world, 1.0 / 60.0);
  double mass = 0.0, moment = 0.0;
  for (const Piece& piece : state.pieces) {
    mass += elastic::total_mass_kg(piece.body);
    moment += elastic::total_mass_kg(piece.body) * elastic::centre_of_mass_m(piece.body).x();
  }
  return 22.5 - moment / mass;
}

/// Of a plate square to its way all the time: v falls as dv/dt = −κv².
double drift_square_on_m(double thickness_m) {
  const double rate = 0.5 * air_density_kgpm3 * 1.15 / (917.0 * thickness_m);
  return 22.5 - std::log(1.0 + rate * 22.5) / rate;
}

}  // namespace

TEST_CASE("air presses a plate along its normal, with 1.15 of the dynamic pressure where it stands square to it") {
  Piece plate = sheet(0.01, quarter_turn, 25.0);
  feel_air(plate, {0, 0, 0});
  const double pressure_pa = 0.5 * air_density_kgpm3 * 625.0;
  CHECK(load_of(plate).force_n.x() == relative(-1.15 * pressure_pa * 2.0 * 1.2, 0.01));
  CHECK(std::abs(load_of(plate).force_n.z()) < 1.0);
  CHECK(load_of(plate).moment_nm.norm() < 1.0);
  // At 20 degrees: half of 1.7, across the plate, and before the middle by 0.3 − 0.22 · 20/38 of two metres.
  const double attack = std::numbers::pi / 9.0, normal_n = 0.85 * pressure_pa * 2.0 * 1.2;
  plate = sheet(0.01, attack, 25.0);
  feel_air(plate, {0, 0, 0});
  const Load load = load_of(plate);
  CHECK(load.force_n.z() == relative(normal_n * std::cos(attack), 0.02));
  CHECK(load.force_n.x() == relative(-normal_n * std::sin(attack), 0.03));
  CHECK(load.moment_nm.y() == relative(-normal_n * 2.0 * (0.3 - 0.22 * 20.0 / 38.0), 0.06));
}

TEST_CASE("a tumbling body's coefficient is the mean of a plate's drag over all attitudes") {
  constexpr int count = 100'000;
  double sum = 0.0;
  for (int k = 0; k < count; ++k) {
    const double sine = (k + 0.5) / count;
    sum += 2.0 * plate_normal_coefficient(sine) * sine / count;
  }
  CHECK(tumbling_coefficient == relative(sum, 0.0005));
}

TEST_CASE("air that goes along with a piece leaves it alone and a wind pushes what stands") {
  Piece plate = sheet(0.01, quarter_turn, 25.0);
  feel_air(plate, {25, 0, 0});
  CHECK(load_of(plate).force_n.norm() < 1e-9);
  plate = sheet(0.01, quarter_turn, 0.0);
  feel_air(plate, {10, 0, 0});
  CHECK(load_of(plate).force_n.x() > 150.0);
}

TEST_CASE("a turn is damped by the air past each face") {
  Piece plate = sheet(0.01, 0.0, 0.0);
  const Eigen::Vector3d centre = elastic::centre_of_mass_m(plate.body), spin(0, 5, 0);
  for (int i = 0; i < plate.body.node_count(); ++i)
    plate.body.velocity_mps[i] = spin.cross(plate.body.position_m[i] - centre);
  feel_air(plate, {0, 0, 0});
  CHECK(load_of(plate).moment_nm.y() < -1.0);
  CHECK(load_of(plate).force_n.norm() < 1e-6);
}

TEST_CASE("a thin sheet of roof ice at 25 metres per second drifts many metres and the thick slab two") {
  for (const double thickness_m : {0.01, 0.02, 0.08}) {
    CAPTURE(thickness_m);
    CHECK(drift_m(thickness_m, quarter_turn) == relative(drift_square_on_m(thickness_m), 0.1));
  }
  CHECK(drift_m(0.01, 0.2) > 6.0);
  CHECK(drift_m(0.02, 0.2) > 3.5);
  CHECK(drift_m(whole_m, 0.2) < 1.2);
  CHECK(drift_square_on_m(0.01) > 9.0);
  CHECK(std::abs(drift_square_on_m(0.08) - 2.0) < 0.2);
}

TEST_CASE("a wind blows a sheet that falls through it along with it") {
  State state;
  Random random(1);
  spawn_part(state, Part::ice_slab, {{0, 0, 20}, glm::angleAxis(quarter_turn, Vec3(0, 1, 0))}, Vec3(0), Vec3(0), random,
             0.01 / whole_m);
  ContactWorld world = level_road();
  world.wind_mps = {15, 0, 0};
  for (int k = 0; k < 54; ++k) advance_debris(state, world, 1.0 / 60.0);
  const double speed = elastic::momentum_ns(state.pieces[0].body).x() / elastic::total_mass_kg(state.pieces[0].body);
  CHECK(speed > 5.0);
  CHECK(speed < 15.0);
}
