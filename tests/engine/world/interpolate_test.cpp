#include "engine/world/interpolate.hpp"

#include <cmath>
#include <utility>

#include <doctest/doctest.h>
#include <glm/gtc/constants.hpp>

#include "tests/relative.hpp"

namespace septet {
namespace {

/// A vehicle on a circle of 50 m at 20 m/s, at time `t`.
Participant on_circle(double t) {
  const double radius = 50.0, rate = 20.0 / radius, angle = rate * t;
  Participant p;
  p.id = 1;
  p.world_from_vehicle.position_m = Vec3(radius * std::sin(angle), -radius * std::cos(angle), 0.0);
  p.world_from_vehicle.orientation = orientation_from_angles(angle, 0.0, 0.0);
  p.velocity_mps = Vec3(std::cos(angle), std::sin(angle), 0.0) * 20.0;
  p.acceleration_mps2 = Vec3(-std::sin(angle), std::cos(angle), 0.0) * (20.0 * rate);
  p.angular_velocity_radps = Vec3(0.0, 0.0, rate);
  p.wheel_spin_radps = 62.5;
  p.wheel_spin_rad = std::fmod(62.5 * t, 2.0 * 3.14159265358979323846);
  return p;
}

}  // namespace

TEST_CASE("a vehicle on a circle is within a micrometre of it between two ticks") {
  const double h = 1.0 / 120.0;
  for (double t = 0.0; t <= 1.0; t += 0.125) {
    const Participant shown = interpolate(on_circle(0.0), on_circle(h), h, t);
    const Participant truth = on_circle(t * h);
    CHECK(glm::length(shown.world_from_vehicle.position_m - truth.world_from_vehicle.position_m) < 1e-6);
    CHECK(std::abs(heading_rad(shown.world_from_vehicle.orientation) - 0.4 * t * h) < 1e-9);
    CHECK(shown.wheel_spin_rad == doctest::Approx(truth.wheel_spin_rad));
  }
}

TEST_CASE("an angular acceleration is followed quadratically") {
  // From rest to 0.2 rad/s over one tick: the angle runs as t squared.
  Participant before = on_circle(0.0), after = before;
  before.velocity_mps = after.velocity_mps = before.acceleration_mps2 = after.acceleration_mps2 = Vec3(0.0);
  before.angular_velocity_radps = Vec3(0.0);
  after.angular_velocity_radps = Vec3(0.0, 0.0, 0.2);
  const double h = 0.1, end = 0.5 * 0.2 * h;
  after.world_from_vehicle.orientation = orientation_from_angles(end, 0.0, 0.0);
  const Participant shown = interpolate(before, after, h, 0.5);
  CHECK(heading_rad(shown.world_from_vehicle.orientation) == doctest::Approx(0.25 * end));
}

TEST_CASE("wheels that speed up or brake turn as they would") {
  const double h = 1.0 / 30.0;
  for (const auto& rates :
       {std::pair{10.0, 40.0}, std::pair{40.0, 10.0}, std::pair{-20.0, -5.0}, std::pair{0.0, 30.0}}) {
    const double from = rates.first, to = rates.second;
    Participant before = on_circle(0.0), after = on_circle(h);
    before.wheel_spin_radps = from;
    after.wheel_spin_radps = to;
    const auto angle = [&](double t) { return 1.0 + from * t + 0.5 * (to - from) / h * t * t; };
    const auto turned = [](double rad) {
      return rad - 2.0 * glm::pi<double>() * std::floor(rad / (2.0 * glm::pi<double>()));
    };
    before.wheel_spin_rad = turned(angle(0.0));
    after.wheel_spin_rad = turned(angle(h));
    for (const double t : {0.25, 0.5, 0.75})
      CHECK(interpolate(before, after, h, t).wheel_spin_rad == doctest::Approx(turned(angle(t * h))));
  }
}

TEST_CASE("a teleported vehicle is not smeared across the gap") {
  Participant after = on_circle(1.0 / 120.0);
  after.world_from_vehicle.position_m.x += 300.0;
  const Participant shown = interpolate(on_circle(0.0), after, 1.0 / 120.0, 0.5);
  CHECK(shown.world_from_vehicle.position_m.x == doctest::Approx(0.0));
}

TEST_CASE("a vehicle is a metre off what its velocities say before it counts as teleported") {
  const double h = 1.0 / 120.0;
  for (const double off_m : {0.9, 1.1}) {
    Participant after = on_circle(h);
    after.world_from_vehicle.position_m.z += off_m;
    CHECK((interpolate(on_circle(0.0), after, h, 0.5).world_from_vehicle.position_m.z > 0.1) == (off_m < 1.0));
  }
  // Over a long gap it may have sped up or braked meanwhile.
  Participant before = on_circle(0.0), after = before;
  before.velocity_mps = after.velocity_mps = Vec3(0.0);
  after.world_from_vehicle.position_m.x += 5.5;
  CHECK(interpolate(before, after, 0.5, 0.5).world_from_vehicle.position_m.x > 1.0);
  after.world_from_vehicle.position_m.x += 1.0;
  CHECK(interpolate(before, after, 0.5, 0.5).world_from_vehicle.position_m.x == before.world_from_vehicle.position_m.x);
}

TEST_CASE("position velocity and acceleration at both ends shape the motion between them") {
  // x(t) = t⁵ + 2t⁴ − 3t³ + t² + 4t + 5 over two seconds is of the fifth degree, so that it is met everywhere.
  const auto at = [](double t) {
    Participant p;
    p.world_from_vehicle.position_m.x = ((((t + 2.0) * t - 3.0) * t + 1.0) * t + 4.0) * t + 5.0;
    p.velocity_mps.x = (((5.0 * t + 8.0) * t - 9.0) * t + 2.0) * t + 4.0;
    p.acceleration_mps2.x = ((20.0 * t + 24.0) * t - 18.0) * t + 2.0;
    return p;
  };
  for (const double t : {0.3, 1.0, 1.7})
    CHECK(interpolate(at(0.0), at(2.0), 2.0, t / 2.0).world_from_vehicle.position_m.x ==
          relative(at(t).world_from_vehicle.position_m.x, 1e-12));
}

TEST_CASE("what else moves is between its two values in proportion to the time") {
  Participant before = on_circle(0.0), after = on_circle(1.0 / 120.0);
  before.front_steer_rad = 0.1, after.front_steer_rad = 0.5;
  before.wheel_lift_m = {0.0, 0.1, 0.2, 0.3}, after.wheel_lift_m = {0.4, 0.1, 0.0, -0.1};
  before.lamps.set(Lamp::brake, true);
  const Participant shown = interpolate(before, after, 1.0 / 120.0, 0.25);
  CHECK(shown.front_steer_rad == doctest::Approx(0.2));
  CHECK(shown.wheel_lift_m[0] == doctest::Approx(0.1));
  CHECK(shown.wheel_lift_m[3] == doctest::Approx(0.2));
  CHECK(glm::length(shown.velocity_mps - glm::mix(before.velocity_mps, after.velocity_mps, 0.25)) < 1e-12);
  CHECK(glm::length(shown.acceleration_mps2 - glm::mix(before.acceleration_mps2, after.acceleration_mps2, 0.25)) <
        1e-12);
  CHECK(shown.lamps.has(Lamp::brake));  // Switched at the tick, not before it.
}

TEST_CASE("who is not there any more stays to the end of the interval and who is new appears at it") {
  Snapshot a, b;
  b.simulated_time_s = 1.0;
  a.participants = {on_circle(0.0)};
  b.participants = {on_circle(0.0)};
  b.participants[0].id = 2;
  const Snapshot between = interpolate(a, b, 0.5);
  REQUIRE(between.participants.size() == 1);
  CHECK(between.participants[0].id == 1);
  CHECK(between.simulated_time_s == 0.5);
  CHECK(interpolate(a, b, -3.0).simulated_time_s == 0.0);
  CHECK(interpolate(a, b, 1.0).participants[0].id == 2);
}

TEST_CASE("both ends are met exactly") {
  Snapshot a, b;
  a.tick = 1;
  b.tick = 2;
  b.simulated_time_s = 1.0 / 120.0;
  a.participants = {on_circle(0.0)};
  b.participants = {on_circle(b.simulated_time_s)};
  CHECK(interpolate(a, b, 0.0).participants[0].world_from_vehicle.position_m ==
        a.participants[0].world_from_vehicle.position_m);
  CHECK(interpolate(a, b, 1.0).participants[0].world_from_vehicle.position_m ==
        b.participants[0].world_from_vehicle.position_m);
}

}  // namespace septet
