#include "engine/sight/lookout.hpp"

#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

namespace septet::sight {
namespace {

constexpr std::uint32_t target = 5;

Box upright(const Vec3& foot_m, const Vec3& size_m) {
  return {{foot_m + Vec3(0.0, 0.0, 0.5 * size_m.z), Quat(1.0, 0.0, 0.0, 0.0)}, 0.5 * size_m};
}

const Box walker = upright({40.0, 0.0, 0.0}, {0.4, 0.6, 1.75});

bool sees(const Vec3& eye_m, const std::vector<OpaqueBody>& bodies, const Box& box = walker) {
  return Lookout(eye_m, bodies, nullptr).seen_point(target, box, [](const Vec3&) { return true; }).has_value();
}

}  // namespace

TEST_CASE("a body is seen from where the first of its corners clears the one before it") {
  // A van from x = 30 to 36 whose side towards the eye's way is at y = 1.
  const std::vector<OpaqueBody> van{{3, upright({33.0, 0.0, 0.0}, {6.0, 2.0, 2.5})}};
  // The line to the walker's farther corner (40.19, 0.285), the first to come, passes the van's corner (36, 1).
  const double clears_m = 40.19 - (3.0 - 0.285) * (40.19 - 36.0) / (1.0 - 0.285);
  CHECK_FALSE(sees({clears_m - 0.1, 3.0, 1.2}, van));
  CHECK(sees({clears_m + 0.1, 3.0, 1.2}, van));
  CHECK(sees({clears_m - 0.1, 3.0, 1.2}, {}));
}

TEST_CASE("a low body hides the legs of who stands behind it and not the head") {
  const Box child = upright({40.0, 0.0, 0.0}, {0.3, 0.4, 0.85});
  const std::vector<OpaqueBody> low{{3, upright({33.0, 0.0, 0.0}, {4.0, 2.0, 0.93})}},
      high{{3, upright({33.0, 0.0, 0.0}, {4.0, 2.0, 2.0})}};
  CHECK(sees({0.0, 0.0, 1.2}, low));
  CHECK_FALSE(sees({0.0, 0.0, 1.2}, low, child));
  CHECK_FALSE(sees({0.0, 0.0, 1.2}, high));
  CHECK(sees({0.0, 0.0, 6.0}, high));  // 2.2 m high over its end.
}

TEST_CASE("a body hides neither itself nor who sits in it, and nothing that is before it") {
  CHECK(sees({0.0, 0.0, 1.2}, {{target, walker}}));
  CHECK(sees({0.0, 0.0, 1.2}, {{3, upright({0.0, 0.0, 0.0}, {5.0, 2.0, 1.5})}}));
  CHECK(sees({0.0, 0.0, 1.2}, {{3, upright({45.0, 0.0, 0.0}, {5.0, 9.0, 4.0})}}));
}

TEST_CASE("a long body near the eye hides what is at its side and a wall does as well") {
  const std::vector<OpaqueBody> lorry{{3, upright({8.0, -2.0, 0.0}, {16.5, 2.5, 4.0})}};
  const Box beside = upright({12.0, -6.0, 0.0}, {4.5, 1.8, 1.45});
  CHECK_FALSE(sees({2.0, 2.0, 1.2}, lorry, beside));
  CHECK(sees({2.0, 2.0, 1.2}, {}, beside));
  const Walls walls({{{-5.0, -4.0}, {50.0, -4.0}, 0.0, 3.0}});
  const auto point_m =
      Lookout({2.0, 2.0, 1.2}, {}, &walls).seen_point(target, beside, [](const Vec3&) { return true; });
  CHECK_FALSE(point_m.has_value());
}

TEST_CASE("what the air hides is not seen, and the point that is seen is told") {
  const Lookout lookout({0.0, 0.0, 1.2}, {}, nullptr);
  const auto to = [&](double farthest_m) {
    return lookout.seen_point(target, walker, [&](const Vec3& at) { return glm::length(at) < farthest_m; });
  };
  CHECK_FALSE(to(39.0).has_value());
  REQUIRE(to(45.0).has_value());
  CHECK(to(45.0)->x == doctest::Approx(39.81));
}

}  // namespace septet::sight
