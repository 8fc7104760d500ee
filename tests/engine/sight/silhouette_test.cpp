#include "engine/sight/silhouette.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::sight {
namespace {

Box box(const Vec3& middle_m, const Vec3& size_m, double heading_rad = 0.0) {
  return {{middle_m, orientation_from_angles(heading_rad, 0.0, 0.0)}, 0.5 * size_m};
}

Surroundings behind(std::span<const Box> boxes) {
  Surroundings between;
  between.boxes = boxes;
  return between;
}

}  // namespace

TEST_CASE("a line enters a box at its near face, begins inside at zero, and passes beside and away from it") {
  const Box cube = box({10, 0, 0}, {2, 4, 2}, 0.5 * std::numbers::pi);
  CHECK(*entry_m(cube, {{0, 0, 0}, {1, 0, 0}}) == doctest::Approx(8.0));  // Turned: its length lies along x.
  CHECK(*entry_m(cube, {{10, 0.5, 0}, {1, 0, 0}}) == 0.0);
  CHECK_FALSE(entry_m(cube, {{0, 1.1, 0}, {1, 0, 0}}));
  CHECK_FALSE(entry_m(cube, {{0, 0, 0}, {-1, 0, 0}}));
}

TEST_CASE("light through air falls by the integral of its extinction") {
  const Line line{{1, 2, 3}, glm::normalize(Vec3(3, 4, 0))};
  CHECK(transmittance(line, 20.0, 0.5, [](const Vec3&) { return 0.1; }) == doctest::Approx(std::exp(-2.0)));
  // Linear in x: the midpoint rule is exact. ∫ 0.02 x ds over 20 m, x from 1 to 13.
  CHECK(transmittance(line, 20.0, 3.0, [](const Vec3& at) { return 0.02 * at.x; }) ==
        doctest::Approx(std::exp(-0.02 * 7.0 * 20.0)));
  CHECK(transmittance(line, 0.0, 0.5, [](const Vec3&) { return 1.0; }) == 1.0);
}

TEST_CASE("a wall before half of a body leaves half of its silhouette, and one behind it all") {
  const Vec3 eye_m(0, 0, 1);
  const Box body = box({20, 0, 1}, {0.1, 2, 2}, 0.0);
  const std::vector<Box> half{box({10, -5, 0}, {0.1, 10, 20})}, rear{box({30, 0, 0}, {0.1, 90, 90})},
      whole{box({10, 0, 0}, {0.1, 90, 90})};
  CHECK(sight_of_box(eye_m, body, behind(half), 64).share() == relative(0.5, 0.02));
  CHECK(sight_of_box(eye_m, body, behind(rear), 64).share() == 1.0);
  CHECK(sight_of_box(eye_m, body, behind(whole), 64).share() == 0.0);
  const Sight alone = sight_of_box(eye_m, body, {}, 64);
  CHECK(alone.transmittance == 1.0);
  CHECK(alone.nearest_m == relative(19.95, 1e-3));
  CHECK(alone.solid_angle_sr == relative(4.0 / (19.95 * 19.95), 0.03));
}

TEST_CASE("a body behind smoke keeps its share and loses light") {
  Surroundings smoke;
  smoke.extinction_per_m = [](const Vec3& at) { return at.x > 5 && at.x < 10 ? 0.3 : 0.0; };
  smoke.step_m = 0.05;
  const Sight sight = sight_of_box({0, 0, 1}, box({40, 0, 1}, {1, 1, 1}), smoke);
  CHECK(sight.share() == 1.0);
  CHECK(sight.transmittance == relative(std::exp(-1.5), 0.02));
}

TEST_CASE("the raster holds the whole body, near and far, and one around the eye too") {
  for (const double distance_m : {1.5, 5.0, 400.0})
    for (const double heading : {0.0, 0.7, 2.0}) {
      CAPTURE(distance_m);
      const Box body = box({distance_m * std::cos(heading), distance_m * std::sin(heading), 0.3}, {1, 1, 2}, 0.4);
      const Raster raster(Vec3(0.0), body, 32);
      CHECK(std::max(raster.width(), raster.height()) == 32);
      // Corners lie on lines within the picture: those of its rim come within a pixel of each extreme corner.
      const double pixel_rad =
          std::acos(std::min(1.0, glm::dot(raster.line(0, 0).direction, raster.line(1, 0).direction)));
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 to =
            glm::normalize(body.world_from_box *
                           (Vec3((corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1) * body.half_m));
        double nearest_rad = 9.0;
        for (std::uint32_t y = 0; y < raster.height(); ++y)
          for (std::uint32_t x = 0; x < raster.width(); ++x)
            nearest_rad = std::min(nearest_rad, std::acos(std::min(1.0, glm::dot(to, raster.line(x, y).direction))));
        CHECK(nearest_rad < 2.5 * pixel_rad);
      }
    }
  CHECK(sight_of_box({0, 0, 0}, box({0.2, 0, 0}, {2, 2, 2}), {}).share() == 1.0);
}

}  // namespace septet::sight
