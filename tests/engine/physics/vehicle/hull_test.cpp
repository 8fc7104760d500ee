#include "engine/physics/vehicle/hull.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "tests/engine/physics/vehicle/hull_drive.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("a car that runs into a wall crushes as far as its speed says and hardly comes back") {
  const Obstacle across = wall({4.5, -20.0}, {4.5, 20.0});
  for (const double speed : {2.0, 8.0, 15.0}) {
    CAPTURE(speed);
    const Drive drive = drive_into({across}, {0.0, 0.0}, 0.0, speed, 0.8 / speed + 0.5);
    CHECK(drive.deepest_m == relative(speed / 23.5, 0.05));  // C = V/ω.
    REQUIRE(drive.report.over.size() == 1);
    const HullTouch& blow = drive.report.over.front();
    CHECK(blow.closing_speed_mps == relative(speed, 0.05));
    CHECK(blow.delta_v_mps.x < -speed);  // All of it, and a little rebound,
    CHECK(blow.delta_v_mps.x > -1.6 * speed);
    CHECK(drive.state.velocity_mps.x < 0.0);
    CHECK(std::abs(heading_rad(drive.state)) < 0.02);
  }
}

TEST_CASE("beyond its crumple zone a car is six times as stiff") {
  constexpr double speed = 25.0, crumple_m = 0.7;
  const Drive drive = drive_into({wall({4.5, -20.0}, {4.5, 20.0})}, {0.0, 0.0}, 0.0, speed, 0.5);
  // V²/ω² = C² + 5 (C − 0.7)².
  const double soft_m = speed / 23.5, c = crumple_m;
  const double expected_m = (5.0 * c + std::sqrt(25.0 * c * c - 6.0 * (5.0 * c * c - soft_m * soft_m))) / 6.0;
  CHECK(drive.deepest_m == relative(expected_m, 0.03));
}

TEST_CASE("nothing is driven through at any speed and angle") {
  for (const double speed : {5.0, 30.0, 60.0})
    for (const double degrees : {5.0, 20.0, 45.0, 70.0, 90.0, -10.0}) {
      CAPTURE(speed);
      CAPTURE(degrees);
      // Towards a wall along x at y = 3, from 6 m before it.
      const double heading = degrees * 3.14159265 / 180.0;
      const Drive drive = drive_into({wall({-400.0, 3.0}, {900.0, 3.0})}, {0.0, -2.0}, heading, speed, 3.0);
      CHECK(drive.state.world_from_body.position_m.y < 3.0);
      const Vec2 ahead(std::cos(heading), std::sin(heading));
      for (const double beside : {0.0, 0.4, -0.7}) {
        const Vec2 at = 8.0 * ahead + beside * Vec2(-ahead.y, ahead.x);
        const Drive trunk_drive = drive_into({trunk(at, 0.1)}, {0.0, 0.0}, heading, speed, 8.0 / speed + 0.3);
        if (std::abs(beside) < 0.6)
          CHECK(glm::dot(Vec2(trunk_drive.state.world_from_body.position_m), ahead) < 8.0);
        else  // A corner may be torn past it, for a price.
          CHECK(glm::length(trunk_drive.state.velocity_mps) < 0.8 * speed);
      }
    }
}

TEST_CASE("a car slides along a rail and is neither held nor thrown") {
  for (const double speed : {10.0, 30.0, 60.0})
    for (const double degrees : {2.0, 5.0, 10.0, 20.0}) {
      CAPTURE(speed);
      CAPTURE(degrees);
      const double heading = degrees * 3.14159265 / 180.0;
      const double before_m = 2.85 - 3.8 * std::sin(heading) - 0.95 * std::cos(heading);  // Its corner is short of it.
      const Drive drive = drive_into({wall({-100.0, 3.0}, {900.0, 3.0})}, {0.0, before_m}, heading, speed, 3.0);
      const double along = speed * std::cos(heading), into = speed * std::sin(heading);
      CHECK(drive.state.velocity_mps.x >
            along - 2.2 * into);  // Coulomb's share of the impulse, and the part taken by the yaw.
      CHECK(drive.state.velocity_mps.x < along + 0.1);
      CHECK(drive.state.velocity_mps.y > -0.6 * into - 0.5);
      CHECK(drive.report.begun.size() == 1);
    }
}

TEST_CASE("a rail of many stretches is the same as one") {
  std::vector<Obstacle> stretches;
  for (int k = 0; k < 50; ++k) {
    Obstacle stretch = wall({10.0 * k - 100.0, 3.0}, {10.0 * k - 90.0, 3.0});
    stretch.open_from = k == 0;
    stretch.open_to = k == 49;
    stretches.push_back(stretch);
  }
  const Drive many = drive_into(stretches, {0.0, 0.0}, 0.25, 25.0, 2.0);
  const Drive one = drive_into({wall({-100.0, 3.0}, {400.0, 3.0})}, {0.0, 0.0}, 0.25, 25.0, 2.0);
  CHECK(glm::length(many.state.world_from_body.position_m - one.state.world_from_body.position_m) < 0.05);
  CHECK(many.report.begun.size() == 1);
}

TEST_CASE("a rail that bends to or from a car moves it by no jump, and keeps it on its side") {
  constexpr double radius_m = 80.0, step_rad = 10.0 / radius_m;
  for (const bool outside : {false, true}) {
    std::vector<Obstacle> bend;
    // A circle that touches the x axis from above or from below; the car is below the axis.
    const Vec2 centre_m(0.0, outside ? radius_m : -radius_m);
    const auto at = [&](int k) {
      return centre_m + radius_m * Vec2(std::sin(k * step_rad), (outside ? -1.0 : 1.0) * std::cos(k * step_rad));
    };
    for (int k = -8; k < 16; ++k) {
      Obstacle stretch = wall(at(k), at(k + 1));
      stretch.open_from = k == -8;
      stretch.open_to = k == 15;
      bend.push_back(stretch);
    }
    for (const double speed : {10.0, 25.0}) {
      CAPTURE(outside);
      CAPTURE(speed);
      Drive drive = drive_into(bend, {-2.0, -3.5}, outside ? 0.35 : 0.12, speed, 0.001);
      DriverInput input;
      input.selector = GearSelector::neutral;
      double most_jump_m = 0.0;
      for (int i = 0; i < 2500; ++i) {
        const Vec3 before_m = drive.state.world_from_body.position_m;
        go_on(bend, input, 0.0011, drive);
        most_jump_m = std::max(most_jump_m, glm::distance(drive.state.world_from_body.position_m, before_m));
      }
      MESSAGE("outside " << outside << ": at " << speed << " m/s, farthest in a step " << most_jump_m
                         << " m, set apart " << drive.set_apart_m << " m, touches " << drive.report.begun.size());
      CHECK(!drive.report.begun.empty());
      CHECK(most_jump_m < 0.001 * speed + 0.02);
      CHECK(drive.most_beyond_m < 0.02);
      const double from_centre_m = glm::distance(Vec2(drive.state.world_from_body.position_m), centre_m);
      CHECK((from_centre_m > radius_m) == outside);
    }
  }
}

TEST_CASE(
    "a car that leaves a rail for a fifth of a second scrapes along it still and after a second touches it anew") {
  const VehicleParameters& car = hull_car();
  const Obstacle rail = wall({-100.0, 3.0}, {900.0, 3.0});
  const VehicleState upright = standstill(car, {Vec3(0.0, 0.0, 0.0), Quat(1, 0, 0, 0)}, 20.0);
  HullState hull;
  HullReport report;
  double x_m = 0.0;
  // Held at a distance from the rail: two centimetres in it, or half a metre off.
  const auto hold = [&](bool touching, double time_s) {
    for (int i = 0; i < static_cast<int>(time_s * 1000.0 + 0.5); ++i) {
      VehicleState state = upright;
      state.world_from_body.position_m.x += x_m += 0.02;
      state.world_from_body.position_m.y += (touching ? 2.94 : 2.44) - 0.5 * car.body.width_m;
      advance_hull(car, std::span(&rail, 1), 0.001, {}, state, hull, report);
    }
  };
  for (int k = 0; k < 4; ++k) {
    hold(true, 0.05);
    hold(false, 0.2);
  }
  CHECK(report.begun.size() == 1);
  CHECK(report.over.size() == 1);
  hold(false, 0.25);
  CHECK(hull.touches.size() == 1);
  hold(false, 0.1);
  CHECK(hull.touches.empty());
  hold(true, 0.05);
  CHECK(report.begun.size() == 2);
  hold(false, 0.09);
  CHECK(report.over.size() == 1);  // It might come back.
  hold(false, 0.02);
  CHECK(report.over.size() == 2);
  hold(true, 0.05);
  CHECK(report.begun.size() == 2);
}

TEST_CASE("a trunk beside the middle turns the car about it") {
  const Drive left = drive_into({trunk({8.0, 0.6}, 0.2)}, {0.0, 0.0}, 0.0, 15.0, 0.7);
  const Drive right = drive_into({trunk({8.0, -0.6}, 0.2)}, {0.0, 0.0}, 0.0, 15.0, 0.7);
  CHECK(heading_rad(left.state) > 0.1);
  CHECK(heading_rad(right.state) == relative(-heading_rad(left.state), 0.05));
}

TEST_CASE("a marker post takes the momentum of its mass, by the law of all impacts, and no more") {
  const Drive drive = drive_into({trunk({8.0, 0.0}, 0.06, 3.0)}, {0.0, 0.0}, 0.0, 30.0, 0.6);
  const VehicleParameters& car = hull_car();
  REQUIRE(drive.report.over.size() == 1);
  CHECK(drive.report.over.front().delta_v_mps.x ==
        relative(-(1.0 + impact::restitution(30.0)) * 30.0 * 3.0 / (car.body.mass_kg + 3.0), 0.02));
  CHECK(drive.state.velocity_mps.x > 29.0);
  CHECK(*std::ranges::max_element(drive.hull.crush_m) == 0.0);
}

TEST_CASE("the end of a rail is met and what is too low or too high is not") {
  const Drive end = drive_into({wall({10.0, 0.2}, {60.0, 0.2})}, {0.0, 0.0}, 0.0, 15.0, 0.8);
  CHECK(end.report.begun.size() == 1);
  CHECK(end.state.velocity_mps.x < 2.0);
  Obstacle bridge = wall({10.0, -20.0}, {10.0, 20.0});
  bridge.low_m = 4.5;
  bridge.high_m = 6.0;
  Obstacle kerb = wall({10.0, -20.0}, {10.0, 20.0});
  kerb.high_m = 0.12;
  CHECK(drive_into({bridge, kerb}, {0.0, 0.0}, 0.0, 15.0, 1.0).report.begun.empty());
}

TEST_CASE("a blow takes energy and gives none") {
  for (const double degrees : {10.0, 40.0, 80.0})
    for (const double beside : {-0.8, 0.0, 0.5}) {
      const VehicleParameters& car = hull_car();
      const double heading = degrees * 3.14159265 / 180.0;
      const Drive drive = drive_into({wall({-100.0, 3.0}, {100.0, 3.0}), trunk({12.0, 1.0 + beside}, 0.2)}, {0.0, 0.0},
                                     heading, 20.0, 1.5);
      CHECK(mechanical_energy_j(car, drive.state) < mechanical_energy_j(car, standstill(car, {}, 20.0)));
      CHECK(drive.most_mps2 < 800.0);
    }
}
