#include "sim-client/film/accident/camera_clearance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/opendrive_reader.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::film {
namespace {

std::shared_ptr<const roadside::Obstacles> village() {
  static const auto obstacles = [] {
    const auto roads = road::read_opendrive(shipped_text("scenarios/first-lesson/first-lesson.xodr"), "first-lesson");
    REQUIRE_MESSAGE(roads.has_value(), why_not(roads));
    return std::make_shared<const roadside::Obstacles>(*roads, 1);
  }();
  return obstacles;
}

constexpr double far_m = 1.0;  ///< What is farther than this in one direction is far enough.

/// Least distance in plan of p from the listed obstacles that reach as high as it, by points along each, 5 cm apart.
double sampled_distance_m(const Vec3& p) {
  double least_m = 1e300;
  for (const Obstacle& obstacle : village()->listed()) {
    const double reach_m = far_m + obstacle.radius_m;
    if (p.x < std::min(obstacle.from_m.x, obstacle.to_m.x) - reach_m ||
        p.x > std::max(obstacle.from_m.x, obstacle.to_m.x) + reach_m ||
        p.y < std::min(obstacle.from_m.y, obstacle.to_m.y) - reach_m ||
        p.y > std::max(obstacle.from_m.y, obstacle.to_m.y) + reach_m || p.z > obstacle.high_m || p.z < obstacle.low_m)
      continue;
    const int steps = std::max(1, static_cast<int>(glm::length(obstacle.to_m - obstacle.from_m) / 0.05));
    for (int n = 0; n <= steps; ++n) {
      const Vec2 on = glm::mix(obstacle.from_m, obstacle.to_m, static_cast<double>(n) / steps);
      least_m = std::min(least_m, glm::length(Vec2(p) - on) - obstacle.radius_m);
    }
  }
  return least_m;
}

/// Least distance of p from a body, by points of its box 10 cm apart.
double sampled_distance_from_body_m(const Vec3& p, const Involved& one) {
  const VehicleModel& model = vehicle_models()[one.model];
  const WayPoint& at = one.way.front();
  if (glm::length(p - at.position_m) > model.length_m + model.width_m + far_m) return far_m;
  const Vec3 in_vehicle = glm::conjugate(orientation_from_angles(at.heading_rad, 0, 0)) * (p - at.position_m);
  double least_m = 1e300;
  for (double x = -model.rear_overhang_m; x <= model.front_m(); x += 0.1) {
    if (std::abs(x - in_vehicle.x) > far_m) continue;
    for (double y = -model.width_m / 2.0; y <= model.width_m / 2.0; y += 0.1)
      for (double z = 0.0; z <= model.height_m; z += 0.1)
        least_m = std::min(least_m, glm::length(in_vehicle - Vec3(x, y, z)));
  }
  return least_m;
}

}  // namespace

TEST_CASE("of 10,000 random shots none has its camera nearer than 0.3 m to a solid or in a house or in the ground") {
  const Solids solids(village());
  std::mt19937 dice(7);
  const auto between = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice); };
  const auto listed = village()->listed();
  REQUIRE(listed.size() > 100);
  int left_out = 0, moved = 0;
  for (int n = 0; n < 10'000; ++n) {
    // Beside something that stands: most random places of the road are clear of everything.
    const Obstacle& near = listed[std::uniform_int_distribution<std::size_t>(0, listed.size() - 1)(dice)];
    const Vec2 place = near.from_m + Vec2(between(-9.0, 9.0), between(-9.0, 9.0));
    const double ground_m = village()->terrain().height_m(place);
    AccidentFacts facts;
    const WayPoint at{1.0, Vec3(place, ground_m), between(-3.0, 3.0), 0.0};
    facts.involved.push_back({.number = 1, .model = *find_vehicle_model("saloon"), .way = {at}});
    const WayPoint beside{1.0, at.position_m + Vec3(between(-9.0, 9.0), between(-9.0, 9.0), 0.0), between(-3.0, 3.0),
                          0.0};
    facts.bystanders.push_back({.number = 2, .model = *find_vehicle_model("lorry"), .way = {beside}});
    Shot shot{.from_s = 0.0, .to_s = 2.0, .participant = "1", .distance_m = between(3.0, 14.0)};
    shot.heading_rad = between(-3.1, 3.1);
    shot.pitch_rad = between(-0.6, 0.0);
    if (n % 3 == 0) shot.place_m = at.position_m + Vec3(0.0, 0.0, between(0.5, 20.0));
    const auto clear = cleared(shot, facts, solids);
    if (!clear) {
      ++left_out;
      continue;
    }
    if (clear->place_m != shot.place_m || clear->heading_rad != shot.heading_rad ||
        clear->distance_m != shot.distance_m)
      ++moved;
    const Vec3 eye_m = camera_pose(*clear, clear->place_m ? nullptr : &facts.involved[0], at).eye_m;
    REQUIRE(eye_m.z >= village()->terrain().height_m(Vec2(eye_m)) + 0.299);
    for (const auto* one : {&facts.involved[0], &facts.bystanders[0]})
      REQUIRE(sampled_distance_from_body_m(eye_m, *one) >= 0.299);
    // What stands without an upper end is as high as the camera where it is no higher than anything drawn.
    if (eye_m.z < village()->terrain().height_m(Vec2(eye_m)) + endless_above_ground_m)
      REQUIRE(sampled_distance_m(eye_m) >= 0.299);
  }
  CAPTURE(left_out);
  CHECK(moved > 1000);
  CHECK(left_out < 2000);
}

TEST_CASE("a camera within a house is moved and one behind it does not see its participant") {
  const Solids solids(village());
  const auto listed = village()->listed();
  const auto wall = std::ranges::find(listed, ObstacleKind::house, &Obstacle::kind);
  REQUIRE(wall != listed.end());
  Vec2 middle(0.0);
  double walls = 0.0;
  for (const Obstacle& other : listed)
    if (other.kind == ObstacleKind::house && other.run == wall->run) middle += other.from_m, walls += 1.0;
  middle /= walls;
  const double ground_m = village()->terrain().height_m(middle);
  CHECK(solids.distance_m(Vec3(middle, ground_m + 1.5), 0.6) == 0.0);
  CHECK(solids.distance_m(Vec3(middle, ground_m + endless_above_ground_m + 5.0), 0.6) == doctest::Approx(0.6));
  // Through the house: the participant on the one side, the camera on the other.
  const Vec2 out = glm::normalize(0.5 * (wall->from_m + wall->to_m) - middle);
  AccidentFacts facts;
  const Vec2 place = middle + 18.0 * out;
  const WayPoint at{1.0, Vec3(place, village()->terrain().height_m(place)), std::atan2(out.y, out.x), 0.0};
  facts.involved.push_back({.number = 1, .model = *find_vehicle_model("saloon"), .way = {at}});
  Shot through{.from_s = 0.0, .to_s = 2.0, .participant = "1", .distance_m = 36.0};
  through.pitch_rad = -0.05;
  CHECK_FALSE(is_clear(through, facts, solids));  // Behind it, and so through the house.
}

}  // namespace septet::film
