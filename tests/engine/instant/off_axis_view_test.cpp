#include "engine/instant/off_axis_view.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

constexpr double height_px = 1080.0;

/// Seven screens around the car, 51.4° apart, 2.4 m wide; neighbours share an edge.
std::vector<ScreenCorners> ring_of_seven() {
  const double half_angle = M_PI / 7.0, distance_m = 2.0;
  const double radius_m = distance_m / std::cos(half_angle);
  std::vector<ScreenCorners> screens;
  for (int i = 0; i < 7; ++i) {
    const double left = 2.0 * half_angle * i + half_angle, right = left - 2.0 * half_angle;
    const Vec3 lower_left(radius_m * std::cos(left), radius_m * std::sin(left), 0.6);
    const Vec3 lower_right(radius_m * std::cos(right), radius_m * std::sin(right), 0.6);
    screens.push_back({lower_left, lower_right, lower_left + Vec3(0, 0, 1.2)});
  }
  return screens;
}

Vec3 ndc(const OffAxisView& view, const Vec3& point_m) {
  const glm::dvec4 clip = view.clip_from_eye_relative * glm::dvec4(point_m - view.eye_m, 1.0);
  return Vec3(clip) / clip.w;
}

/// Pixel row as the device computes it: everything relative to the eye is float.
double device_row(const OffAxisView& view, const RigidTransform& world_from_car, const Vec3& world_m) {
  const glm::dmat4 clip_from_world =
      view.clip_from_eye_relative * glm::dmat4(glm::mat4_cast(glm::conjugate(world_from_car.orientation)));
  const glm::vec3 relative(world_m - world_from_car * view.eye_m);
  const glm::vec4 clip = glm::mat4(clip_from_world) * glm::vec4(relative, 1.0f);
  return (0.5 + 0.5 * clip.y / clip.w) * height_px;
}

double worst_seam_px(const Vec3& eye_m, const Vec3& car_m) {
  const std::vector<ScreenCorners> screens = ring_of_seven();
  const RigidTransform world_from_car{car_m, orientation_from_angles(0.83, -0.02, 0.01)};
  double worst = 0.0;
  for (std::size_t i = 0; i < screens.size(); ++i) {
    const std::size_t right = (i + 6) % 7;
    const OffAxisView a = *off_axis_view(screens[i], eye_m), b = *off_axis_view(screens[right], eye_m);
    for (double height = 0.0; height <= 1.0; height += 0.125)
      for (const double far : {3.0, 40.0, 700.0}) {
        // A point on the ray from the eye through the shared edge.
        const Vec3 edge = glm::mix(screens[i].lower_right_m, screens[i].lower_right_m + Vec3(0, 0, 1.2), height);
        const Vec3 world_m = world_from_car * (eye_m + far * (edge - eye_m));
        worst =
            std::max(worst, std::abs(device_row(a, world_from_car, world_m) - device_row(b, world_from_car, world_m)));
      }
  }
  return worst;
}

}  // namespace

TEST_CASE("the corners of a screen map to the corners of the picture") {
  for (const Vec3 eye_m : {Vec3(0.0, 0.0, 1.2), Vec3(0.1, -0.07, 1.15), Vec3(-0.3, 0.35, 1.3)})
    for (const ScreenCorners& corners : ring_of_seven()) {
      const OffAxisView view = *off_axis_view(corners, eye_m);
      const Vec3 lower_left = ndc(view, corners.lower_left_m), lower_right = ndc(view, corners.lower_right_m),
                 upper_left = ndc(view, corners.upper_left_m);
      CHECK(std::abs(lower_left.x + 1.0) < 1e-5);
      CHECK(std::abs(lower_left.y - 1.0) < 1e-5);
      CHECK(std::abs(lower_right.x - 1.0) < 1e-5);
      CHECK(std::abs(lower_right.y - 1.0) < 1e-5);
      CHECK(std::abs(upper_left.x + 1.0) < 1e-5);
      CHECK(std::abs(upper_left.y + 1.0) < 1e-5);
    }
}

TEST_CASE("depth is 1 at the near plane and falls to 0 far away") {
  const OffAxisView view = symmetric_view({0, 0, 0}, 0.0, 0.0, 1.0, 0.7, 0.2);
  CHECK(ndc(view, {0.2, 0, 0}).z == doctest::Approx(1.0));
  CHECK(ndc(view, {0.4, 0, 0}).z == doctest::Approx(0.5));
  CHECK(ndc(view, {1e9, 0, 0}).z == doctest::Approx(0.0));
}

TEST_CASE("a point on a shared edge lands at one height on both screens with the world 100 km from its origin") {
  CHECK(worst_seam_px({0.05, -0.1, 1.2}, {0, 0, 0}) <= 0.05);
  CHECK(worst_seam_px({0.05, -0.1, 1.2}, {100e3, -100e3, 80}) <= 0.05);
}

TEST_CASE("moving the eye by 10 cm keeps the seams closed") {
  for (const Vec3 step : {Vec3(0.1, 0, 0), Vec3(0, 0.1, 0), Vec3(0, 0, 0.1), Vec3(-0.1, -0.1, 0.1)})
    CHECK(worst_seam_px(Vec3(0.05, -0.1, 1.2) + step, {100e3, 70e3, 0}) <= 0.05);
}

TEST_CASE("an eye on or behind the screen is refused") {
  const ScreenCorners corners{{2, 1, 0.5}, {2, -1, 0.5}, {2, 1, 1.5}};
  CHECK(off_axis_view(corners, {0, 0, 1}).has_value());
  CHECK_FALSE(off_axis_view(corners, {2, 0, 1}).has_value());
  CHECK_FALSE(off_axis_view(corners, {3, 0, 1}).has_value());
}

TEST_CASE("corners that are not those of a rectangle are refused") {
  CHECK_FALSE(off_axis_view({{2, 1, 0}, {2, -1, 0}, {2, 0.9, 1}}, {0, 0, 0.5}).has_value());
  CHECK_FALSE(off_axis_view({{2, 1, 0}, {2, 1, 0}, {2, 1, 1}}, {0, 0, 0.5}).has_value());
  CHECK_FALSE(off_axis_view({{2, 1, 0}, {2, -1, 0}, {2, 1, 0}}, {0, 0, 0.5}).has_value());
  const double nan = std::nan("");
  CHECK_FALSE(off_axis_view({{2, nan, 0}, {2, -1, 0}, {2, 1, 1}}, {0, 0, 0.5}).has_value());
}

TEST_CASE("a free camera is the off-axis view of a screen straight ahead of it") {
  const OffAxisView free = symmetric_view({0.2, 0.1, 1.2}, 0.0, 0.0, 2.0 * std::atan(0.5), 2.0 * std::atan(0.25));
  const OffAxisView screen = *off_axis_view({{2.2, 1.1, 0.7}, {2.2, -0.9, 0.7}, {2.2, 1.1, 1.7}}, {0.2, 0.1, 1.2});
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      CHECK(free.clip_from_eye_relative[i][j] ==
            doctest::Approx(screen.clip_from_eye_relative[i][j]).epsilon(1e-9).scale(1.0));
}

}  // namespace septet::instant
