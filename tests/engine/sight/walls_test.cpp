#include "engine/sight/walls.hpp"

#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

namespace septet::sight {

TEST_CASE(
    "a wall hides what is behind it up to its height and within its length, at any distance and from either side") {
  const Walls walls({{{100.0, -5.0}, {100.0, 5.0}, 0.0, 3.0}});
  const Vec3 eye_m(-90.0, 0.0, 1.2), behind_m(190.0, 0.0, 1.0);
  CHECK(walls.hide(eye_m, behind_m));
  CHECK(walls.hide(behind_m, eye_m));
  CHECK_FALSE(walls.hide(eye_m, {99.0, 0.0, 1.0}));                // Before it.
  CHECK_FALSE(walls.hide({-90.0, 0.0, 8.0}, behind_m));            // Over it: 3.25 m high there.
  CHECK(walls.hide({-90.0, 0.0, 7.0}, behind_m));                  // 2.9 m.
  CHECK_FALSE(walls.hide(eye_m, {190.0, 7.6, 1.0}));               // Past its end: 5.2 m aside there.
  CHECK(walls.hide(eye_m, {190.0, 7.2, 1.0}));                     // 4.9 m.
  CHECK_FALSE(walls.hide({100.0, -9.0, 1.0}, {100.0, 9.0, 1.0}));  // Along it.
}

TEST_CASE("a line meets each wall on its way through the squares of the plane, in every direction") {
  for (const double x : {-1.0, 0.0, 1.0})
    for (const double y : {-1.0, 0.0, 1.0}) {
      if (x == 0.0 && y == 0.0) continue;
      const Vec2 way(x, y), left(-y, x), from(17.0, -3.0);
      for (const double away_m : {4.0, 33.0, 120.0, 201.0}) {
        const Vec2 at = from + away_m * way;
        const Walls walls({{at - 0.5 * left, at + 0.5 * left, 0.0, 3.0}});
        CHECK(walls.hide(Vec3(from, 1.0), Vec3(from + 230.0 * way, 1.0)));
        CHECK_FALSE(walls.hide(Vec3(from, 1.0), Vec3(from - 230.0 * way, 1.0)));
      }
    }
}

TEST_CASE("a wall of a thing that is gone hides nothing, and what has no thing stays") {
  const Walls walls({{{10.0, -5.0}, {10.0, 5.0}, 0.0, 3.0, 7}});
  const std::vector<std::uint32_t> others{2, 9}, itself{2, 7};
  CHECK(walls.hide({0, 0, 1}, {20, 0, 1}, others));
  CHECK_FALSE(walls.hide({0, 0, 1}, {20, 0, 1}, itself));
  CHECK_FALSE(Walls().hide({0, 0, 1}, {20, 0, 1}));
}

}  // namespace septet::sight
