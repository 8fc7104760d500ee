// Vehicles that slide on locked wheels, against the closed form and the anchor's integration of a spin-out.

#include "engine/physics/vehicle/sliding.hpp"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

constexpr double dt_s = 1.0 / 120.0;
constexpr double degree_rad = std::numbers::pi / 180.0;

/// Four equal loads, wheelbase 2.6 m, track 1.5 m.
LockedWheels four_equal_wheels(double friction) {
  LockedWheels wheels;
  for (std::size_t i = 0; i < wheels.size(); ++i)
    wheels[i] = {{i < 2 ? 1.3 : -1.3, i % 2 == 0 ? 0.75 : -0.75}, 0.25, friction};
  return wheels;
}

impact::Body moving(double mass_kg, double inertia_kgm2, const Vec2& velocity_mps, double yaw_rate_radps) {
  impact::Body body;
  body.mass_kg = mass_kg;
  body.yaw_inertia_kgm2 = inertia_kgm2;
  body.velocity_mps = velocity_mps;
  body.yaw_rate_radps = yaw_rate_radps;
  return body;
}

/// Seconds until it rests, in ticks.
double slide_to_rest(const LockedWheels& wheels, impact::Body& body) {
  double time_s = 0.0;
  for (; (body.velocity_mps != Vec2(0.0) || body.yaw_rate_radps != 0.0) && time_s < 10.0; time_s += dt_s)
    advance_sliding(wheels, dt_s, body);
  return time_s;
}

}  // namespace

TEST_CASE("a car that slides straight on stops after v²/2μg, and stays") {
  for (const double speed_mps : {3.0, 14.0, 30.0}) {
    impact::Body body = moving(1500.0, 2500.0, {speed_mps, 0.0}, 0.0);
    const LockedWheels wheels = four_equal_wheels(0.7);
    const double time_s = slide_to_rest(wheels, body);
    CHECK(body.mass_centre_m.x == relative(speed_mps * speed_mps / (2.0 * 0.7 * 9.81), 0.005));
    CHECK(time_s == doctest::Approx(speed_mps / (0.7 * 9.81)).epsilon(0.01).scale(5.0));
    CHECK(std::abs(body.heading_rad) < 1e-9);
    const Vec2 rest_m = body.mass_centre_m;
    advance_sliding(wheels, dt_s, body);
    CHECK(body.mass_centre_m == rest_m);
  }
}

// The anchor's pair B after its impact, integrated elsewhere: 7.736 m ahead, 1.440 m aside and 119.8° in 1.608 s; and
// 6.049 m, 9.395 m and 313.1° in 1.993 s.
TEST_CASE("the spin-outs of two cars on locked wheels are those of the anchor within 3 %") {
  const LockedWheels wheels = four_equal_wheels(0.7);
  impact::Body first = moving(1500.0, 2500.0, {9.975572, 1.944940}, 2.333928);
  CHECK(slide_to_rest(wheels, first) == relative(1.608, 0.03));
  CHECK(first.mass_centre_m.x == relative(7.736, 0.03));
  CHECK(first.mass_centre_m.y == relative(1.440, 0.03));
  CHECK(first.heading_rad == relative(119.8 * degree_rad, 0.03));
  impact::Body second = moving(1200.0, 1900.0, {6.280535, 9.568825}, 5.195037);
  second.heading_rad = 0.5 * std::numbers::pi;
  CHECK(slide_to_rest(wheels, second) == relative(1.993, 0.03));
  CHECK(second.mass_centre_m.x == relative(6.049, 0.03));
  CHECK(second.mass_centre_m.y == relative(9.395, 0.03));
  CHECK(second.heading_rad - 0.5 * std::numbers::pi == relative(313.1 * degree_rad, 0.03));
}

TEST_CASE("a car that turns on the spot is slowed by μmgR/I") {
  impact::Body body = moving(1200.0, 1900.0, {0.0, 0.0}, 5.0);
  advance_sliding(four_equal_wheels(0.7), dt_s, body);
  CHECK((5.0 - body.yaw_rate_radps) / dt_s == relative(0.7 * 1200.0 * 9.81 * std::hypot(1.3, 0.75) / 1900.0, 1e-6));
  CHECK(glm::length(body.velocity_mps) < 1e-12);
}

TEST_CASE("a car with two wheels on ice turns towards the other side") {
  LockedWheels wheels = four_equal_wheels(0.7);
  wheels[0].friction = wheels[2].friction = 0.1;  // To the left.
  impact::Body body = moving(1500.0, 2500.0, {20.0, 0.0}, 0.0);
  for (int i = 0; i < 60; ++i) advance_sliding(wheels, dt_s, body);
  CHECK(body.yaw_rate_radps < -0.3);
}
