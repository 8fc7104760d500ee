// The law of impacts where a hull meets walls and posts: what it gives back, how deep it goes, what it tells.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/impact/restitution.hpp"
#include "tests/engine/physics/vehicle/hull_drive.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

Obstacle wall_across() { return wall({4.5, -20.0}, {4.5, 20.0}); }

Drive into_wall(double speed_mps) {
  return drive_into({wall_across()}, {0.0, 0.0}, 0.0, speed_mps, 0.8 / speed_mps + 0.4);
}

/// Change of speed by the obstacle alone: all change less that of the vehicle's own steps, which the tyres make.
Vec2 by_obstacle_mps(const Drive& drive, const Vec2& speed_mps) {
  return Vec2(drive.state.velocity_mps) - speed_mps - drive.by_tyres_mps;
}

}  // namespace

TEST_CASE("a wall gives back 0.10 to 0.15 of the speed from 30 km/h on, less of a higher one, and more of a touch") {
  double last = 1.0;
  for (const double speed : {1.0, 3.0, 8.4, 10.0, 15.6, 30.0, 60.0}) {
    CAPTURE(speed);
    const Drive drive = into_wall(speed);
    REQUIRE(drive.report.over.size() == 1);
    const HullTouch& blow = drive.report.over.front();
    const double back = -by_obstacle_mps(drive, {speed, 0.0}).x / blow.closing_speed_mps - 1.0;
    CHECK(back < last);
    CHECK(back == relative(impact::restitution(blow.closing_speed_mps), 0.005));
    if (speed > 8.0) {
      CHECK(back >= 0.10);
      CHECK(back <= 0.15);
    }
    last = back;
  }
}

TEST_CASE("the change of speed that is told is the one that the car had, less the tyres' share") {
  struct Row {
    std::vector<Obstacle> obstacles;
    double heading_deg, speed_mps;
  };
  const Obstacle along = wall({-400.0, 3.0}, {900.0, 3.0});
  for (const Row& row :
       {Row{{wall_across()}, 0.0, 6.0}, Row{{wall_across()}, 0.0, 25.0}, Row{{along}, 20.0, 27.8},
        Row{{along}, 45.0, 15.0}, Row{{trunk({8.0, 0.0}, 0.2)}, 0.0, 15.0}, Row{{trunk({8.0, 0.5}, 0.2)}, 0.0, 12.0}}) {
    CAPTURE(row.heading_deg);
    CAPTURE(row.speed_mps);
    const double heading = row.heading_deg * std::numbers::pi / 180.0;
    const Vec2 before = row.speed_mps * Vec2(std::cos(heading), std::sin(heading));
    Drive drive = drive_into(row.obstacles, {0.0, 0.0}, heading, row.speed_mps, 0.05);
    for (int i = 0; i < 3000 && drive.report.over.empty(); ++i) go_on(row.obstacles, {}, 0.0011, drive);
    REQUIRE(drive.report.over.size() == 1);
    const double told = glm::length(drive.report.over.front().delta_v_mps);
    const double lost = glm::length(by_obstacle_mps(drive, before));
    MESSAGE("told " << told << " m/s, lost to the obstacle " << lost << ", in all "
                    << glm::distance(Vec2(drive.state.velocity_mps), before));
    CHECK(told == relative(lost, 0.001));
  }
}

TEST_CASE(
    "up to 60 m/s no hull is in an obstacle by more than it is crushed, nor in a wall by more than the law says") {
  const impact::Stiffness own{hull_car().body.mass_kg, passenger_car_crush()}, fast{INFINITY, passenger_car_crush()};
  for (const double speed : {2.0, 8.0, 20.0, 40.0, 60.0}) {
    CAPTURE(speed);
    const double law_m = impact::depth_m(impact::crush_curve(own, fast), speed);
    for (const double degrees : {0.0, 10.0, 20.0, 45.0, 70.0}) {
      CAPTURE(degrees);
      const double heading = degrees * std::numbers::pi / 180.0;
      // Met at this angle from square on.
      const Drive drive = drive_into({wall({6.0, -400.0}, {6.0, 400.0})}, {0.0, 0.0}, heading, speed,
                                     6.0 / (speed * std::cos(heading)) + 0.3);
      CHECK(drive.report.begun.size() == 1);
      CHECK(drive.most_beyond_m <= 0.01);
      CHECK(drive.most_overlap_m <= law_m + 0.01);
      CHECK(drive.state.world_from_body.position_m.x < 6.0);
    }
    for (const double beside_m : {0.0, 0.4, -0.4}) {
      CAPTURE(beside_m);
      const Drive drive = drive_into({trunk({8.0, beside_m}, 0.2)}, {0.0, 0.0}, 0.0, speed, 4.2 / speed + 0.5);
      CHECK(drive.most_beyond_m <= 0.01);
      CHECK(drive.state.world_from_body.position_m.x < 8.0);
      CHECK(drive.state.velocity_mps.x < 0.15 * speed);
    }
  }
}

TEST_CASE("the energy that a hull loses to a wall or a post is its crush and its friction") {
  for (const double speed : {8.0, 30.0})
    for (const bool round : {false, true}) {
      CAPTURE(speed);
      CAPTURE(round);
      const std::vector<Obstacle> obstacles{round ? trunk({8.0, 0.4}, 0.2) : wall({-400.0, 3.0}, {900.0, 3.0})};
      const Drive drive = drive_into(obstacles, {0.0, 0.0}, round ? 0.0 : 0.5, speed, 8.0 / speed + 0.2);
      REQUIRE(drive.hull.touches.size() == 1);
      CHECK(drive.ledger.kinetic_j > 0.0);
      CHECK(drive.ledger.kinetic_j == relative(drive.ledger.crush_j + drive.ledger.friction_j, 1e-6));
      CHECK(drive.ledger.kinetic_j == relative(drive.lost_j, 1e-6));
      // The obstacle has what the car has lost.
      const Vec2 before = round ? Vec2(speed, 0.0) : speed * Vec2(std::cos(0.5), std::sin(0.5));
      const Vec2 taken_ns = -hull_car().body.mass_kg * by_obstacle_mps(drive, before);
      CHECK(glm::distance(taken_ns, drive.given_ns) < 1e-9 * glm::length(taken_ns));
    }
}

TEST_CASE("a mirrored world has the mirrored crash and a turned one the turned") {
  const Drive one = drive_into({wall({-400.0, 3.0}, {900.0, 3.0})}, {0.0, 0.0}, 0.4, 20.0, 0.8);
  const Drive mirrored = drive_into({wall({-400.0, -3.0}, {900.0, -3.0})}, {0.0, 0.0}, -0.4, 20.0, 0.8);
  const Drive turned_round =
      drive_into({wall({3.0, 400.0}, {3.0, -900.0})}, {0.0, 0.0}, 0.4 - 0.5 * std::numbers::pi, 20.0, 0.8);
  REQUIRE(one.report.over.size() == 1);
  REQUIRE(mirrored.report.over.size() == 1);
  REQUIRE(turned_round.report.over.size() == 1);
  const Vec2 told = one.report.over[0].delta_v_mps, other = mirrored.report.over[0].delta_v_mps,
             round = turned_round.report.over[0].delta_v_mps;
  CHECK(glm::distance(told, Vec2(other.x, -other.y)) < 1e-6 * glm::length(told));
  CHECK(glm::distance(told, Vec2(-round.y, round.x)) < 1e-6 * glm::length(told));
  const Vec3 end = one.state.world_from_body.position_m, end_mirrored = mirrored.state.world_from_body.position_m;
  CHECK(glm::distance(end, Vec3(end_mirrored.x, -end_mirrored.y, end_mirrored.z)) < 1e-4);
}

TEST_CASE("a scrape of seven centimetres at a trunk is felt and told, and is no crash") {
  const double beside_m = 0.5 * hull_car().body.width_m + 0.2 - 0.07;
  const Drive drive = drive_into({trunk({8.0, beside_m}, 0.2)}, {0.0, 0.0}, 0.0, 20.0, 1.0);
  REQUIRE(drive.report.over.size() == 1);
  const double delta_v = glm::length(drive.report.over[0].delta_v_mps);
  MESSAGE("a scrape changes the velocity by " << delta_v << " m/s");
  CHECK(delta_v > 0.2);
  CHECK(delta_v < 3.0);
  CHECK(drive.report.over[0].delta_v_mps.y < 0.0);
  CHECK(drive.state.velocity_mps.x > 17.0);
  CHECK(drive.state.world_from_body.position_m.x > 10.0);
}

TEST_CASE("two that are met at once stop a car once") {
  const double speed = 15.0;
  const Drive trees = drive_into({trunk({8.0, 0.6}, 0.2), trunk({8.0, -0.6}, 0.2)}, {0.0, 0.0}, 0.0, speed, 0.6);
  Obstacle second = wall({4.5, -20.0}, {4.5, 20.0});
  second.run = 1;
  const Drive walls = drive_into({wall_across(), second}, {0.0, 0.0}, 0.0, speed, 0.6);
  for (const Drive* drive : {&trees, &walls}) {
    const double back = -by_obstacle_mps(*drive, {speed, 0.0}).x / speed - 1.0;
    CHECK(back > 0.0);
    CHECK(back < 0.2);
    CHECK(drive->most_beyond_m <= 0.01);
  }
}

TEST_CASE("a car that pushes against a wall with all its engine stays where it is and is not crushed on") {
  Drive drive = drive_into({wall_across()}, {0.0, 0.0}, 0.0, 2.0, 0.6);
  DriverInput full;
  full.accelerator = 1.0;
  go_on({wall_across()}, full, 2.0, drive);
  const double x_m = drive.state.world_from_body.position_m.x, crush_m = drive.deepest_m;
  go_on({wall_across()}, full, 6.0, drive);
  CHECK(std::abs(drive.state.world_from_body.position_m.x - x_m) < 0.02);
  CHECK(drive.deepest_m - crush_m < 0.005);
  CHECK(drive.most_pulses < 200);
  MESSAGE("pulses at once at most " << drive.most_pulses << ", crush " << drive.deepest_m);
}

TEST_CASE("where a hull was crushed before it is stiffer from the start") {
  const Drive first = into_wall(10.0);
  Drive second = first;
  second.hull.touches.clear();
  second.report = {};
  second.most_mps2 = 0.0;
  second.state = standstill(hull_car(), {}, 10.0);
  go_on(
      {wall_across()},
      [] {
        DriverInput input;
        input.selector = GearSelector::neutral;
        return input;
      }(),
      0.5, second);
  REQUIRE(second.report.over.size() == 1);
  CHECK(second.most_mps2 > 1.2 * first.most_mps2);
  CHECK(second.deepest_m > first.deepest_m + 0.05);
  CHECK(second.deepest_m < 1.9 * first.deepest_m);
}
