#include "engine/physics/vehicle/tyre.hpp"

#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

TyreContact rolling(double load_n, double longitudinal_slip, double lateral_slip) {
  TyreContact contact;
  contact.load_n = load_n;
  contact.rolling_mps = contact.forward_mps = 20.0;
  contact.sliding_mps = {-20.0 * longitudinal_slip, -20.0 * lateral_slip};
  return contact;
}

}  // namespace

TEST_CASE("cornering stiffness grows less than the load") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const double light = load_sensitive_force(tyre, rolling(3000.0, 0.0, 0.01)).force_n.y;
  const double heavy = load_sensitive_force(tyre, rolling(6000.0, 0.0, 0.01)).force_n.y;
  CHECK(heavy > light);
  CHECK(heavy < 1.95 * light);
}

TEST_CASE("braking takes from the side force and no slip gives more than the friction") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const double alone = load_sensitive_force(tyre, rolling(4000.0, 0.0, 0.08)).force_n.y;
  CHECK(load_sensitive_force(tyre, rolling(4000.0, -0.2, 0.08)).force_n.y < 0.7 * alone);
  for (double x = -1.0; x <= 1.0; x += 0.05)
    for (double y = -1.0; y <= 1.0; y += 0.05) {
      const Vec2 force_n = load_sensitive_force(tyre, rolling(4000.0, x, y)).force_n;
      CHECK(glm::length(force_n) < 1.03 * 4000.0);
      CHECK(force_n.x * x + force_n.y * y >= 0.0);
    }
}

TEST_CASE("the aligning torque falls before the side force does") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  double best_force_slip = 0.0, best_torque_slip = 0.0, best_force = 0.0, best_torque = 0.0;
  for (double slip = 0.005; slip < 0.4; slip += 0.005) {
    const TyreForce force = load_sensitive_force(tyre, rolling(4000.0, 0.0, slip));
    if (force.force_n.y > best_force) best_force = force.force_n.y, best_force_slip = slip;
    const double torque = force.trail_m * force.force_n.y;
    if (torque > best_torque) best_torque = torque, best_torque_slip = slip;
  }
  CHECK(best_torque_slip < 0.7 * best_force_slip);
}

TEST_CASE("the side force peaks where the curves say at the nominal load and at twice of it") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const LoadSensitiveTyre& curves = tyre.load_sensitive;
  for (const auto& [load_n, curve] :
       {std::pair(4000.0, curves.lateral_nominal), std::pair(8000.0, curves.lateral_double)}) {
    double best_n = 0.0, best_slip = 0.0;
    for (double slip = 0.01; slip < 0.6; slip += 0.001) {
      const double force_n = load_sensitive_force(tyre, rolling(load_n, 0.0, slip)).force_n.y;
      if (force_n > best_n) best_n = force_n, best_slip = slip;
    }
    CHECK(best_n == relative(curve.peak_force_n, 1e-4));
    CHECK(best_slip == relative(curve.peak_slip, 0.01));
    CHECK(load_sensitive_force(tyre, rolling(load_n, 0.0, 1e-5)).force_n.y / 1e-5 == relative(curve.slope_n, 1e-3));
    CHECK(load_sensitive_force(tyre, rolling(load_n, 0.0, 0.9)).force_n.y == relative(curve.sliding_force_n, 1e-4));
  }
  // Beyond two and a half times the nominal load the parabola is no longer trusted.
  const double at_10_kn = load_sensitive_force(tyre, rolling(10e3, 0.0, 0.2)).force_n.y;
  CHECK(load_sensitive_force(tyre, rolling(20e3, 0.0, 0.2)).force_n.y == doctest::Approx(2.0 * at_10_kn));
}

TEST_CASE("half the friction halves the peak and keeps the slope") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const auto force_n = [&](double friction, double slip) {
    TyreContact contact = rolling(4000.0, 0.0, slip);
    contact.friction = friction;
    return load_sensitive_force(tyre, contact).force_n.y;
  };
  CHECK(force_n(0.45, 0.085) == doctest::Approx(0.5 * force_n(0.9, 0.17)));
  CHECK(force_n(0.45, 1e-5) == relative(force_n(0.9, 1e-5), 1e-3));
}

TEST_CASE("a tyre that leans to the right pushes to the right") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  TyreContact leaning = rolling(4000.0, 0.0, 0.0);
  leaning.inclination_rad = 0.01;
  const double slope_n = tyre.load_sensitive.lateral_nominal.slope_n;
  CHECK(load_sensitive_force(tyre, leaning).force_n.y ==
        relative(-0.01 * tyre.load_sensitive.camber_slip * slope_n, 0.02));
}

TEST_CASE("the pneumatic trail begins as its share of the contact and ends a little in front of the middle") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const auto trail_m = [&](double slip) {
    TyreContact contact = rolling(4000.0, 0.0, slip);
    contact.length_m = 0.14;
    return load_sensitive_force(tyre, contact).trail_m;
  };
  const double whole_m = tyre.load_sensitive.trail_over_length * 0.14;
  CHECK(trail_m(0.0) == doctest::Approx(whole_m));
  CHECK(trail_m(0.5 * tyre.load_sensitive.trail_zero_slip) < 0.6 * whole_m);
  CHECK(trail_m(1.5 * tyre.load_sensitive.trail_zero_slip) == relative(-0.05 * whole_m, 1e-6));
}

TEST_CASE("a patch carries no more than the surface can hold and springs back from there") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const TyreForce steady = load_sensitive_force(tyre, rolling(4000.0, 0.05, 0.1));
  Vec2 deflection_m{0.0};
  Vec2 force_n{0.0};
  for (int i = 0; i < 1000; ++i) force_n = relax(steady, 1000.0, 0.001, deflection_m);
  CHECK(glm::length(force_n) == doctest::Approx(1000.0));
  CHECK(force_n.x * steady.force_n.y == relative(force_n.y * steady.force_n.x, 0.2));
  // The deflection is cut with the force: nothing is wound up behind it.
  const Vec2 held_n = steady.stiffness_npm * deflection_m;
  CHECK(glm::length(held_n) < 1200.0);
}

TEST_CASE("the side force builds up over the relaxation length") {
  const TyreParameters tyre = read_car("volvo-s80").tyre;
  const TyreContact contact = rolling(4000.0, 0.0, 0.01);
  const TyreForce steady = load_sensitive_force(tyre, contact);
  // (d v + f) dy/dt = v (F - c y), force c y + d dy/dt: the damper carries the share d v / (d v + f) at once, and the
  // length is (d v + f) / c.
  const double slope_n = steady.secant_n.y, rate_n = steady.damping_nspm.y * 20.0 + slope_n;
  const double length_m = rate_n / tyre.load_sensitive.lateral_stiffness_npm;
  for (const double lengths : {0.5, 1.0, 2.0}) {
    CAPTURE(lengths);
    constexpr double dt_s = 0.00005;
    const int steps = static_cast<int>(lengths * length_m / (20.0 * dt_s) + 0.5);
    Vec2 deflection_m{0.0}, force_n{0.0};
    for (int i = 0; i < steps; ++i) force_n = relax(steady, 1e9, dt_s, deflection_m);
    const double expected = 1.0 - slope_n / rate_n * std::exp(-lengths);
    CHECK(force_n.y / steady.force_n.y == relative(expected, 0.005));
  }
}

TEST_CASE("the published tyre gives the forces of the published package") {
  TyreParameters tyre = read_car("commonroad-bmw-320i").tyre;
  tyre.magic_formula.p_vx1 = 0.0;  // The package has this shift in the wrong place.
  struct Point {
    double braking_slip, slip_angle_rad, inclination_rad, load_n, longitudinal_n, lateral_n;
  };
  // Computed with commonroad-vehicle-models 3.0.2, utils/tire_model.py, in its axes (y to the
  // right), p_vx1 = 0.
  constexpr Point points[] = {{0.0, 0.03, 0.01, 3000.0, 71.33807529176939, -1771.5848638690113},
                              {0.02, -0.05, -0.02, 4000.0, -1307.7882530039194, 3243.129463189575},
                              {-0.05, 0.02, 0.03, 2500.0, 2081.9149146877353, -1136.227908187406},
                              {0.1, 0.1, -0.01, 5000.0, -3961.9066646094743, -4604.947629781969}};
  for (const Point& point : points) {
    TyreContact contact;
    contact.load_n = point.load_n;
    contact.friction = tyre.reference_friction;
    contact.forward_mps = 1000.0;  // So that the guard against standstill does not show.
    contact.sliding_mps = {1000.0 * point.braking_slip, -1000.0 * std::tan(point.slip_angle_rad)};
    contact.inclination_rad = point.inclination_rad;
    const Vec2 force_n = published_force(tyre, contact).force_n;
    CHECK(force_n.x == relative(point.longitudinal_n, 1e-6));
    CHECK(force_n.y == relative(-point.lateral_n, 1e-6));
  }
}
