#include "engine/instant/wet_road.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "engine/instant/clouds.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::instant {
namespace {

double mean_square(const std::vector<glm::vec2>& slopes) {
  double sum = 0.0;
  for (const glm::vec2& slope : slopes) sum += glm::dot(slope, slope);
  return sum / static_cast<double>(slopes.size());
}

}  // namespace

TEST_CASE("water's slopes grow with the rain, lie level without, and are a function of rain and time") {
  CHECK(mean_square(ripple_slopes(0.0, 4.0)) == 0.0);
  CHECK(mean_square(ripple_slopes(-3.0, 4.0)) == 0.0);
  CHECK(mean_square(ripple_slopes(std::nan(""), 4.0)) == 0.0);
  CHECK(mean_square(ripple_slopes(5.0, std::nan(""))) == 0.0);
  double before = 0.0;
  for (const double rain : {1.0, 5.0, 25.0, 100.0}) {
    const double now = mean_square(ripple_slopes(rain, 4.0));
    CHECK(now > 1.2 * before);
    before = now;
  }
  CHECK(ripple_slopes(10.0, 4.0) == ripple_slopes(10.0, 4.0));
  CHECK(ripple_slopes(10.0, 4.0) != ripple_slopes(10.0, 4.05));
  CHECK(std::isfinite(mean_square(ripple_slopes(1e300, 1e300))));
}

TEST_CASE("a quarter of a road under standing water is puddles, none of a damp one, and most of them lie in ruts") {
  const std::vector<std::uint8_t> noise = cloud_noise();
  double damp = 0.0, even = 0.0, rutted = 0.0;
  constexpr int side = 96;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const double at_x = 0.5 * x - 1000.0, at_y = 0.5 * y + 70.0;
      damp += puddle(noise, at_x, at_y, 0.0f, 0.5f) / (side * side);
      even += puddle(noise, at_x, at_y, 0.0f, 1.0f) / (side * side);
      rutted += puddle(noise, at_x, at_y, 1.0f, 1.0f) / (side * side);
    }
  CHECK(damp == 0.0);
  CHECK(even == relative(0.23, 0.15));
  CHECK(rutted > 1.3 * even);
}

TEST_CASE("the road lies where the nearest vehicle's wheels stand, whatever its springs do") {
  const ReferenceScene reference = reference_scene();
  DrawnParticipant near_by = reference_car(reference, {4.0, 0.0, 10.02}),
                   far = reference_car(reference, {50.0, 0.0, 12.0});
  // The nose dives by 0.02 rad, and the front wheels go up into their arches by as much.
  near_by.world_from_vehicle.orientation = glm::angleAxis(0.02, Vec3(0, 1, 0));
  near_by.wheel_lift_m = {0.054, 0.054, 0.0, 0.0};
  const Vec3 eye_m(0.0, 0.0, 11.2);
  const std::vector<DrawnParticipant> both{far, near_by};
  const auto road = road_below(both, reference.scene.prototypes, eye_m);
  REQUIRE(road.has_value());
  CHECK(road->point_m.z == doctest::Approx(10.02));
  CHECK(road->normal.x == doctest::Approx(0.0).scale(1.0).epsilon(1e-4));
  CHECK(road->normal.z == doctest::Approx(1.0));

  CHECK_FALSE(road_below({}, reference.scene.prototypes, eye_m).has_value());
  CHECK_FALSE(road_below(both, reference.scene.prototypes, {0.0, 0.0, 9.0}).has_value());
  CHECK_FALSE(road_below(both, reference.scene.prototypes, {0.0, 300.0, 11.2}).has_value());
  near_by.world_from_vehicle.orientation = glm::angleAxis(1.5, Vec3(1, 0, 0));  // On its side.
  CHECK_FALSE(road_below(std::vector{near_by}, reference.scene.prototypes, eye_m).has_value());
}

}  // namespace septet::instant
