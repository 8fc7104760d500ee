#include "engine/scene/motion.hpp"

#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet::scene {

TEST_CASE("a motion's legs follow each other and each is evenly accelerated and turned") {
  Motion motion{{10, 0, 0}, {1, 0, 0, 0}, {}};
  motion.legs = {{2.0, {4, 0, 0}, {0, 2, 0}, {0, 0, std::numbers::pi / 2}}, {3.0, {0, 0, 0}, {}, {}}};
  const auto at = [&](double time_s) { return pose_at(motion, time_s); };
  CHECK(at(0.0).world_from_object.position_m == Vec3(10, 0, 0));
  CHECK(at(2.0).velocity_mps == Vec3(0));
  const MovingPose half = at(2.5);
  CHECK(glm::length(half.world_from_object.position_m - Vec3(12, 0.25, 0)) < 1e-12);
  CHECK(glm::length(half.velocity_mps - Vec3(4, 1, 0)) < 1e-12);
  CHECK(heading_rad(half.world_from_object.orientation) == doctest::Approx(std::numbers::pi / 4));
  const MovingPose later = at(30.0);
  CHECK(glm::length(later.world_from_object.position_m - Vec3(14, 1, 0)) < 1e-12);
  CHECK(heading_rad(later.world_from_object.orientation) == doctest::Approx(std::numbers::pi / 2));
  CHECK(later.velocity_mps == Vec3(0));
}

}  // namespace septet::scene
