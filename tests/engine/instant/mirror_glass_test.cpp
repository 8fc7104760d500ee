#include "engine/instant/mirror_glass.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <optional>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "tests/engine/instant/reflection_point.hpp"

namespace septet::instant {
namespace {

constexpr PixelRectangle full_hd{0, 0, 1920, 1080};
const Vec3 usual_eye_m(1.35, 0.37, 1.17);

/// A left door mirror's glass, turned to the driver.
ScreenCorners door_glass() {
  const Vec3 middle(1.95, 0.95, 1.0), back = glm::normalize(Vec3(-1.0, -0.25, 0.08));
  const Vec3 right = glm::normalize(glm::cross(Vec3(0, 0, 1), back)), up = glm::cross(back, right);
  const auto corner = [&](double x, double y) { return middle + 0.095 * x * right + 0.056 * y * up; };
  return {corner(-1, -1), corner(1, -1), corner(-1, 1)};
}

/// The left one of three monitors.
OffAxisView left_screen(const Vec3& eye_m) {
  return *off_axis_view({{1.35, 1.294, 0.788}, {2.15, 0.832, 0.788}, {1.35, 1.294, 1.352}}, eye_m);
}

/// Place in the mirror's picture that the glass shows at `place_m` of it, from the eye: of the triangle before it.
std::optional<Vec2> shown_there(const MirrorGlass& mirror, const Vec3& eye_m, const Vec3& place_m) {
  for (std::size_t i = 0; i + 2 < mirror.corners.size(); i += 3) {
    const auto* c = &mirror.corners[i];
    const glm::dmat3 triangle(c[0].position_m - eye_m, c[1].position_m - eye_m, c[2].position_m - eye_m);
    const Vec3 weights = glm::inverse(triangle) * (place_m - eye_m);
    const double sum = weights.x + weights.y + weights.z;
    const Vec3 share = weights / sum;
    if (std::min({share.x, share.y, share.z}) < -1e-9) continue;
    return share.x * Vec2(c[0].at) + share.y * Vec2(c[1].at) + share.z * Vec2(c[2].at);
  }
  return std::nullopt;
}

/// Place of a point of the car's frame in the picture.
Vec2 in_picture(const MirrorGlass& mirror, const Vec3& point_m) {
  const OffAxisView& view = mirror.picture.projection;
  const glm::dvec4 clip = view.clip_from_eye_relative * glm::dvec4(point_m - view.eye_m, 1.0);
  return {0.5 + 0.5 * clip.x / clip.w, 0.5 + 0.5 * clip.y / clip.w};
}

}  // namespace

TEST_CASE("flat and convex glass shows each point where the way of light is shortest, from any eye point") {
  for (const double radius_m : {0.0, 1.2, 1.4})
    for (const Vec3& eye_m : {usual_eye_m, Vec3(1.2, 0.45, 1.05), Vec3(1.45, 0.30, 1.25)}) {
      const auto mirror = mirror_glass(door_glass(), radius_m, left_screen(eye_m), full_hd);
      REQUIRE(mirror);
      CHECK(mirror->wholly_seen);
      const Vec2 size_px(mirror->picture.viewport.width, mirror->picture.viewport.height);
      int compared = 0;
      for (const double away_m : {4.0, 12.0, 60.0})
        for (double aside = -0.5; aside < 0.9; aside += 0.1)
          for (double up = -0.3; up < 0.3; up += 0.1) {
            const Vec3 point_m(1.9 - away_m, 0.95 + aside * away_m, 1.0 + up * away_m);
            const auto at = shown_there(*mirror, eye_m, reflection_point(door_glass(), radius_m, eye_m, point_m));
            if (!at) continue;
            ++compared;
            const Vec2 off_px = (*at - in_picture(*mirror, point_m)) * size_px;
            CHECK(glm::length(off_px) < (radius_m > 0.0 ? 1.5 : 0.02));
          }
      CHECK(compared > (radius_m > 0.0 ? 40 : 6));
    }
}

TEST_CASE("what lies further to the left behind the car is further to the left in the glass") {
  for (const double radius_m : {0.0, 1.4}) {
    const auto seen_at = [&](const Vec3& point_m) {
      const OffAxisView view = left_screen(usual_eye_m);
      const Vec3 place_m = reflection_point(door_glass(), radius_m, usual_eye_m, point_m);
      const glm::dvec4 clip = view.clip_from_eye_relative * glm::dvec4(place_m - view.eye_m, 1.0);
      return Vec2(clip.x / clip.w, clip.y / clip.w);
    };
    CHECK(seen_at({-20, 5, 1}).x < seen_at({-20, 3, 1}).x);
    CHECK(seen_at({-20, 4, 2}).y < seen_at({-20, 4, 0}).y);
    // The picture, which looks back, is mirrored.
    const auto mirror = mirror_glass(door_glass(), radius_m, left_screen(usual_eye_m), full_hd);
    REQUIRE(mirror);
    CHECK(in_picture(*mirror, {-20, 5, 1}).x > in_picture(*mirror, {-20, 3, 1}).x);
  }
}

TEST_CASE("a convex glass shows more than a flat one in a picture of no more pixels than it has on the screen") {
  const auto flat = mirror_glass(door_glass(), 0.0, left_screen(usual_eye_m), full_hd);
  const auto convex = mirror_glass(door_glass(), 1.4, left_screen(usual_eye_m), full_hd);
  REQUIRE(flat);
  REQUIRE(convex);
  const auto breadth = [](const MirrorGlass& mirror) {
    return mirror.picture.projection.right_slope - mirror.picture.projection.left_slope;
  };
  CHECK(breadth(*convex) > 1.8 * breadth(*flat));
  for (const auto& mirror : {*flat, *convex}) {
    CHECK(mirror.picture.viewport.width < 420);
    CHECK(mirror.picture.viewport.height < 260);
    CHECK(mirror.picture.viewport.width > 250);
    for (const MirrorGlass::Corner& corner : mirror.corners) {
      CHECK(std::min(corner.at.x, corner.at.y) > 0.0f);
      CHECK(std::max(corner.at.x, corner.at.y) < 1.0f);
    }
  }
}

TEST_CASE("of a glass at the edge of a screen there is only what that screen shows") {
  const OffAxisView whole = left_screen(usual_eye_m);
  // The same screen cut off in the middle of the glass.
  const glm::dvec4 clip = whole.clip_from_eye_relative *
                          glm::dvec4(0.5 * (door_glass().lower_right_m + door_glass().upper_left_m) - usual_eye_m, 1.0);
  const double share = 0.5 + 0.5 * clip.x / clip.w;
  const Vec3 left(1.35, 1.294, 0.788), right(2.15, 0.832, 0.788);
  const auto cut = off_axis_view({left, glm::mix(left, right, share), {1.35, 1.294, 1.352}}, usual_eye_m);
  REQUIRE(cut);
  const auto all = mirror_glass(door_glass(), 1.4, whole, full_hd);
  const auto half = mirror_glass(door_glass(), 1.4, *cut, {0, 0, static_cast<std::uint32_t>(1920 * share), 1080});
  REQUIRE(all);
  REQUIRE(half);
  CHECK_FALSE(half->wholly_seen);
  CHECK(half->corners.size() < 0.65 * double(all->corners.size()));
  CHECK(half->picture.viewport.width < 0.7 * all->picture.viewport.width);
}

TEST_CASE("a glass that the view does not see is not drawn, nor one seen from behind or of a shape that is none") {
  const auto ahead = off_axis_view({{2.15, 0.832, 0.788}, {2.15, -0.092, 0.788}, {2.15, 0.832, 1.352}}, usual_eye_m);
  REQUIRE(ahead);
  CHECK_FALSE(mirror_glass(door_glass(), 1.4, *ahead, full_hd));
  CHECK_FALSE(mirror_glass(door_glass(), 1.4, symmetric_view({2.6, 1.1, 1.0}, M_PI, 0.0, 1.0, 0.6), full_hd));
  CHECK_FALSE(mirror_glass(door_glass(), 0.11, left_screen(usual_eye_m), full_hd));
  CHECK_FALSE(mirror_glass(door_glass(), 1.4, symmetric_view(usual_eye_m, M_PI, 0.0, 1.0, 0.6), full_hd));
  CHECK_FALSE(mirror_glass({{1, 1, 1}, {1, 1, 1}, {1, 1, 2}}, 1.4, left_screen(usual_eye_m), full_hd));
  ScreenCorners nowhere = door_glass();
  nowhere.upper_left_m.x = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(mirror_glass(nowhere, 1.4, left_screen(usual_eye_m), full_hd));
  CHECK_FALSE(mirror_glass(door_glass(), std::numeric_limits<double>::quiet_NaN(), left_screen(usual_eye_m), full_hd)
                  .has_value());
}

}  // namespace septet::instant
