#include "engine/instant/mirror_view.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

/// A door mirror's glass, which is turned and tilted.
ScreenCorners glass() {
  const Vec3 middle(1.95, 0.95, 1.0), back = glm::normalize(Vec3(-1.0, -0.4, 0.05));
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 0, 1), back)), up = glm::cross(back, right);
  const auto corner = [&](double x, double y) { return middle + 0.1 * x * right + 0.06 * y * up; };
  return {corner(-1, -1), corner(1, -1), corner(-1, 1)};
}

/// Point with the shortest path from the eye over the plane to the point (Fermat), found by stepping: the law of
/// reflection without images.
Vec3 reflection_point(const ScreenCorners& corners, const Vec3& eye_m, const Vec3& point_m) {
  const Vec3 right = glm::normalize(corners.lower_right_m - corners.lower_left_m);
  const Vec3 up = glm::normalize(corners.upper_left_m - corners.lower_left_m);
  const auto length_m = [&](const Vec3& on) { return glm::distance(eye_m, on) + glm::distance(on, point_m); };
  Vec3 best = corners.lower_left_m;
  for (double step_m = 0.2; step_m > 1e-10; step_m *= 0.5)
    for (bool better = true; better;) {
      better = false;
      for (const Vec3& way : {right, -right, up, -up})
        if (length_m(best + step_m * way) < length_m(best) - 1e-16) {
          best += step_m * way;
          better = true;
        }
    }
  return best;
}

/// As the picture shows it to the driver: fractions of the glass from its left and from its lower edge.
Vec2 shown_at(const OffAxisView& view, const Vec3& point_m) {
  const glm::dvec4 clip = view.clip_from_eye_relative * glm::dvec4(point_m - view.eye_m, 1.0);
  REQUIRE(clip.w > 0.0);
  const double x = clip.x / clip.w, y = clip.y / clip.w;  // y points down.
  return {0.5 * (1.0 - x), 0.5 * (1.0 - y)};              // Flipped left to right.
}

Vec2 on_glass(const ScreenCorners& corners, const Vec3& point_m) {
  const Vec3 along = corners.lower_right_m - corners.lower_left_m, up = corners.upper_left_m - corners.lower_left_m;
  const Vec3 offset = point_m - corners.lower_left_m;
  return {glm::dot(offset, along) / glm::dot(along, along), glm::dot(offset, up) / glm::dot(up, up)};
}

}  // namespace

TEST_CASE("a point behind the car is seen in a flat mirror where the law of reflection puts it, from any eye point") {
  for (const Vec3& eye_m : {Vec3(1.35, 0.37, 1.17), Vec3(1.1, 0.5, 1.0), Vec3(1.6, 0.1, 1.35)}) {
    const auto view = mirror_view(glass(), eye_m);
    REQUIRE(view);
    for (const Vec3& point_m : {Vec3(-30, 4, 0.8), Vec3(-8, 2, 0.3), Vec3(-100, -1, 3)}) {
      const Vec2 seen = shown_at(*view, point_m);
      const Vec2 expected = on_glass(glass(), reflection_point(glass(), eye_m, point_m));
      CHECK(seen.x == relative(expected.x, 1e-4));
      CHECK(seen.y == relative(expected.y, 1e-4));
    }
  }
}

TEST_CASE("a convex mirror shows at its middle what a flat one does and more around it") {
  const Vec3 eye_m(1.35, 0.37, 1.17);
  const auto flat = mirror_view(glass(), eye_m), convex = mirror_view(glass(), eye_m, 1.4);
  REQUIRE(flat);
  REQUIRE(convex);
  const Vec3 middle_m = 0.5 * (glass().lower_right_m + glass().upper_left_m);
  const Vec3 ahead_m = middle_m + 40.0 * glm::normalize(middle_m - flat->eye_m);
  for (const auto& view : {*flat, *convex}) {
    CHECK(shown_at(view, ahead_m).x == doctest::Approx(0.5));
    CHECK(shown_at(view, ahead_m).y == doctest::Approx(0.5));
  }
  // The image of an eye 0.8 m away in a mirror of 1.4 m is at 0.7 · 0.8 / 1.5 m: the angle is that much wider.
  const double flat_m = glm::dot(middle_m - flat->eye_m, -flat->back);
  const double share = 0.7 / (flat_m + 0.7);
  CHECK(convex->right_slope - convex->left_slope == relative((flat->right_slope - flat->left_slope) / share, 1e-9));
}

TEST_CASE("nothing between the eye's image and the glass is drawn") {
  const auto view = mirror_view(glass(), {1.35, 0.37, 1.17}, 1.4);
  REQUIRE(view);
  const Vec3 middle_m = 0.5 * (glass().lower_right_m + glass().upper_left_m);
  const auto depth = [&](const Vec3& point_m) {
    const glm::dvec4 clip = view->clip_from_eye_relative * glm::dvec4(point_m - view->eye_m, 1.0);
    return clip.z / clip.w;
  };
  CHECK(depth(glm::mix(view->eye_m, middle_m, 0.999)) > 1.0);
  CHECK(depth(glm::mix(view->eye_m, middle_m, 1.001)) < 1.0);
}

TEST_CASE("a glass that the eye sees from behind, or that is none, is refused") {
  CHECK_FALSE(mirror_view(glass(), {2.6, 0.95, 1.0}));
  CHECK_FALSE(mirror_view({{1, 1, 1}, {1, 1, 1}, {1, 1, 2}}, {0, 0, 0}));
  CHECK_FALSE(mirror_view(glass(), Vec3(std::numeric_limits<double>::quiet_NaN())));
}

}  // namespace septet::instant
