#pragma once
/// Drives of the Volvo's hull into obstacles, rolling free on level ground.

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/physics/vehicle/hull_outline.hpp"
#include "engine/physics/vehicle/planar_body.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "tests/engine/physics/vehicle/car.hpp"

namespace septet::vehicle {

inline Obstacle wall(const Vec2& from_m, const Vec2& to_m) {
  return {.kind = ObstacleKind::guard_rail,
          .from_m = from_m,
          .to_m = to_m,
          .radius_m = 0.08,
          .low_m = -0.3,
          .high_m = 0.75,
          .friction = 0.3};
}

inline Obstacle trunk(const Vec2& at_m, double radius_m, double yielding_kg = 0.0) {
  return {.kind = ObstacleKind::tree,
          .from_m = at_m,
          .to_m = at_m,
          .radius_m = radius_m,
          .low_m = -1.0,
          .high_m = 10.0,
          .yielding_kg = yielding_kg};
}

inline const VehicleParameters& hull_car() {
  static const VehicleParameters car = read_car("volvo-s80");
  return car;
}

struct Drive {
  VehicleState state;
  HullState hull;
  HullReport report;
  double deepest_m = 0.0, most_mps2 = 0.0, set_apart_m = 0.0;
  double most_overlap_m = 0.0;  ///< Of the whole hull with an obstacle.
  double most_beyond_m = 0.0;   ///< Of the hull less what is crushed off it.
  std::size_t most_pulses = 0;
  Vec2 by_tyres_mps{0.0};  ///< Change of velocity in the vehicle's own steps.
  double lost_j = 0.0;     ///< Kinetic energy in plan, lost in the hull's steps.
  impact::Ledger ledger;   ///< Of the last touch.
  Vec2 given_ns{0.0};
};

inline void note(const VehicleParameters& car, const std::vector<Obstacle>& obstacles, Drive& drive) {
  const HullOutline whole = hull_outline(car.body, drive.state);
  const Vec2 mass_centre_m(drive.state.world_from_body.position_m);
  for (const Entered& each : entered_obstacles(whole, mass_centre_m, obstacles, drive.hull.touches)) {
    const auto touch = std::ranges::find(drive.hull.touches, each.obstacle->run, &HullTouch::run);
    if (touch == drive.hull.touches.end()) continue;
    const impact::Outline left = impact::crushed(whole.outline, touch->engagement.first);
    drive.most_beyond_m = std::max(drive.most_beyond_m, -impact::nearest(left, each.outline).gap_m);
    drive.most_overlap_m = std::max(drive.most_overlap_m, -impact::nearest(whole.outline, each.outline).gap_m);
    drive.set_apart_m = std::max(drive.set_apart_m, touch->engagement.set_apart_m);
    drive.most_pulses = std::max(drive.most_pulses, touch->engagement.pulses.size());
  }
  drive.deepest_m = *std::ranges::max_element(drive.hull.crush_m);
}

/// Goes on for a time with constant controls.
inline void go_on(const std::vector<Obstacle>& obstacles, const DriverInput& input, double time_s, Drive& drive) {
  const VehicleParameters& car = hull_car();
  for (int i = 0; i < static_cast<int>(time_s * 1000.0); ++i) {
    const Vec2 before_mps(drive.state.velocity_mps);
    advance_vehicle(car, input, level_ground(), 0.001, drive.state);
    drive.by_tyres_mps += Vec2(drive.state.velocity_mps) - before_mps;
    const impact::Body before = planar_body(car.body, drive.state);
    advance_hull(car, obstacles, 0.001, {}, drive.state, drive.hull, drive.report);
    drive.lost_j += impact::kinetic_loss_j(before, planar_body(car.body, drive.state));
    note(car, obstacles, drive);
    if (!drive.hull.touches.empty()) {
      drive.ledger = drive.hull.touches.back().engagement.ledger;
      drive.given_ns = drive.hull.touches.back().engagement.given_ns;
    }
    drive.most_mps2 = std::max(drive.most_mps2, glm::length(drive.state.whole_acceleration_mps2));
  }
  REQUIRE(drive.state.bad_numbers == 0);
}

/// From the origin of the vehicle frame with this heading and speed, rolling free.
inline Drive drive_into(const std::vector<Obstacle>& obstacles, const Vec2& origin_m, double heading_rad,
                        double speed_mps, double time_s) {
  DriverInput input;
  input.selector = GearSelector::neutral;
  Drive drive;
  drive.state =
      standstill(hull_car(), {Vec3(origin_m, 0.0), orientation_from_angles(heading_rad, 0.0, 0.0)}, speed_mps);
  go_on(obstacles, input, time_s, drive);
  return drive;
}

inline double heading_rad(const VehicleState& state) {
  const Vec3 forward = state.world_from_body.orientation * Vec3(1, 0, 0);
  return std::atan2(forward.y, forward.x);
}

}  // namespace septet::vehicle
