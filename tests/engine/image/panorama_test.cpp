#include "engine/image/panorama.hpp"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/relative.hpp"

namespace septet::image {
namespace {

constexpr double degree_rad = std::numbers::pi / 180.0;

/// A screen of `width_deg` × 30° whose middle is `distance_m` from the eye in the direction
/// `azimuth_deg`.
PanoramaScreen screen_at(const char* name, double azimuth_deg, double width_deg, const Vec3& eye, const Image* image) {
  const double distance_m = 2.0, azimuth = azimuth_deg * degree_rad;
  const Vec3 ahead(std::cos(azimuth), std::sin(azimuth), 0), right(std::sin(azimuth), -std::cos(azimuth), 0);
  const double half_width = distance_m * std::tan(width_deg / 2 * degree_rad);
  const double half_height = distance_m * std::tan(15 * degree_rad);
  const Vec3 middle = eye + ahead * distance_m;
  return {name, middle - right * half_width - Vec3(0, 0, half_height),
          middle + right * half_width - Vec3(0, 0, half_height), middle - right * half_width + Vec3(0, 0, half_height),
          image};
}

const Vec3 eye(1.2, 0.37, 1.15);

Vec3 towards(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * degree_rad, e = elevation_deg * degree_rad;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

}  // namespace

TEST_CASE("a ray meets a screen where trigonometry says") {
  const PanoramaScreen screen = screen_at("centre", 0, 44, eye, nullptr);
  const auto middle = screen_point(screen, eye, towards(0, 0));
  REQUIRE(middle.has_value());
  CHECK(middle->x == doctest::Approx(0.5));
  CHECK(middle->y == doctest::Approx(0.5));
  const auto left = screen_point(screen, eye, towards(10, 0));
  REQUIRE(left.has_value());
  CHECK(left->x == doctest::Approx(0.5 - 0.5 * std::tan(10 * degree_rad) / std::tan(22 * degree_rad)));
  CHECK_FALSE(screen_point(screen, eye, towards(23, 0)).has_value());
  CHECK_FALSE(screen_point(screen, eye, towards(180, 0)).has_value());
}

TEST_CASE("a mark on a screen appears in the panorama at its direction") {
  Image grey(440, 300, {90, 90, 90});
  Image marked = grey;
  const PanoramaScreen plain_screen = screen_at("right", -44, 44, eye, nullptr);
  const Vec3 direction = towards(-52, 6);
  const auto point = screen_point(plain_screen, eye, direction);
  REQUIRE(point.has_value());
  fill(marked, std::llround(point->x * 440) - 4, std::llround(point->y * 300) - 4, 8, 8, {255, 0, 0});
  PanoramaView view;
  view.eye_point_m = eye;
  view.screens = {screen_at("right", -44, 44, eye, &marked), screen_at("centre", 0, 44, eye, &grey),
                  screen_at("left", 44, 44, eye, &grey), screen_at("behind", 180, 30, eye, &grey)};
  view.title = "test";
  const auto picture = unroll(view);
  REQUIRE(picture.has_value());
  const PanoramaLayout layout = layout_panorama(view);
  REQUIRE(layout.rows.size() == 2);
  const Point expected = panorama_pixel(layout, layout.rows[0], direction);
  double x = 0.0, y = 0.0;
  int count = 0;
  for (std::uint32_t py = 0; py < picture->height; ++py)
    for (std::uint32_t px = 0; px < picture->width; ++px)
      if (const Color c = picture->at(px, py); c.red > 200 && c.green < 80) {
        x += px + 0.5;
        y += py + 0.5;
        ++count;
      }
  REQUIRE(count > 20);
  CHECK(x / count == relative(expected.x, 0.001));
  CHECK(y / count == relative(expected.y, 0.005));
}

TEST_CASE("screens ahead stand above screens behind from left to right") {
  PanoramaView view;
  view.eye_point_m = eye;
  const std::array<double, 7> azimuths{-88, 165, 44, 0, -44, 88, -165};
  for (const double azimuth : azimuths)
    view.screens.push_back(screen_at("screen", azimuth, azimuth > 100 || azimuth < -100 ? 30 : 44, eye, nullptr));
  const PanoramaLayout layout = layout_panorama(view);
  REQUIRE(layout.rows.size() == 2);
  CHECK(layout.rows[0].screens == std::vector<std::size_t>{5, 2, 3, 4, 0});
  CHECK(layout.rows[1].screens == std::vector<std::size_t>{6, 1});
  CHECK(layout.rows[0].width_px == relative(2200, 0.001));
  CHECK(layout.rows[1].width_px == relative(600, 0.002));
  CHECK(layout.rows[1].top_px > layout.rows[0].top_px + layout.rows[0].height_px);
}

TEST_CASE("in the plan a screen lies on the side of the eye where it stands") {
  const auto offset_in_plan = [](double azimuth_deg) {
    PanoramaView view;
    view.eye_point_m = eye;
    view.screens = {screen_at("one", azimuth_deg, 20, eye, nullptr)};
    const auto picture = unroll(view);
    REQUIRE(picture.has_value());
    const auto mean_of = [&](Color color, double from_x, double from_y, double to_x, double to_y) {
      double x = 0.0, y = 0.0, count = 0.0;
      for (std::uint32_t py = 0; py < picture->height; ++py)
        for (std::uint32_t px = 0; px < picture->width; ++px)
          if (px >= from_x && px < to_x && py >= from_y && py < to_y && picture->at(px, py) == color)
            x += px, y += py, count += 1.0;
      REQUIRE(count > 10.0);
      return Point{x / count, y / count};
    };
    const Point own = mean_of({255, 196, 84}, 0, 0, 1e9, 1e9);  // The eye's mark.
    const Point there = mean_of({176, 184, 196}, own.x - 150, own.y - 150, own.x + 150, own.y + 150);
    return Point{there.x - own.x, there.y - own.y};
  };
  CHECK(offset_in_plan(90).x < -20.0);
  CHECK(offset_in_plan(-90).x > 20.0);
  CHECK(offset_in_plan(0).y < -20.0);
}

}  // namespace septet::image
