/// A straight line drawn across two screens that share an edge, read back from their pixels.

#include <cmath>
#include <optional>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/render/reference_scene.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t width = 640, height = 420;
const Vec3 car_m(100e3, -80e3, 35.0);

/// A glowing bar 12 m ahead of the car, 16 m long, that rises to one side.
scene::ResolvedScene bar_scene() {
  scene::ResolvedScene scene;
  scene.revision = 1;
  scene::SurfaceMaterial glowing;
  glowing.revision = 1;
  glowing.base_color = glm::vec3(0.0f);
  glowing.emission = glm::vec3(30.0f);
  scene.materials = {glowing};
  scene::SurfaceMesh bar;
  bar.revision = 1;
  const glm::vec3 half(0.05f, 8.0f, 0.05f);
  for (int i = 0; i < 8; ++i)
    bar.vertices.push_back({{i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z}, {-1, 0, 0}, {}});
  bar.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 4, 5, 7, 4, 7, 6, 0, 2, 3, 0, 3, 1};
  bar.parts = {{0, static_cast<std::uint32_t>(bar.indices.size()), 0}};
  bar.bounds_min_m = -half;
  bar.bounds_max_m = half;
  scene.meshes = {bar};
  scene::Instance instance;
  instance.world_from_object = {car_m + Vec3(12, 0, 2.2), orientation_from_angles(0.0, 0.0, 0.07)};
  scene.instances = {instance};
  return scene;
}

/// Height of the bar in a column: the mean row of bright pixels, weighted.
std::optional<double> row_in(const image::Image& picture, std::uint32_t x) {
  double sum = 0.0, weight = 0.0;
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    const double bright = std::max(0, int(picture.at(x, y).red) - 60);
    sum += bright * (y + 0.5);
    weight += bright;
  }
  if (weight < 100.0) return std::nullopt;
  return sum / weight;
}

/// The line's height at a screen's edge, from a straight fit over the columns next to it.
double row_at_edge(const image::Image& picture, bool right_edge) {
  constexpr int columns = 40;
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (int i = 0; i < columns; ++i) {
    const double x = i + 0.5;  // From the edge.
    const auto row = row_in(picture, right_edge ? width - 1 - static_cast<std::uint32_t>(i) : static_cast<std::uint32_t>(i));
    REQUIRE(row.has_value());
    sx += x;
    sy += *row;
    sxx += x * x;
    sxy += x * *row;
  }
  const double slope = (columns * sxy - sx * sy) / (columns * sxx - sx * sx);
  return (sy - slope * sx) / columns;
}

}  // namespace

TEST_CASE("a straight line drawn across two screens meets within a pixel from wherever the eye looks") {
  Expected<Renderer> renderer =
      Renderer::create({width, height, DevicePreference::software, true, Antialiasing::automatic, nullptr});
  REQUIRE(renderer.has_value());
  REQUIRE(renderer->upload(bar_scene()).has_value());
  // Two screens of 44° side by side that meet straight ahead, a little to the left.
  const double radius_m = 2.2;
  const auto corner = [&](double angle) { return Vec3(radius_m * std::cos(angle), radius_m * std::sin(angle), 0.6); };
  const ScreenCorners left{corner(0.85), corner(0.08), corner(0.85) + Vec3(0, 0, 1.2)};
  const ScreenCorners right{corner(0.08), corner(-0.69), corner(0.08) + Vec3(0, 0, 1.2)};
  for (const Vec3 eye_m : {Vec3(0, 0, 1.2), Vec3(0.1, 0, 1.2), Vec3(0, -0.1, 1.2), Vec3(0, 0.05, 1.3)}) {
    FrameInput input;
    input.environment.sun_elevation_rad = -0.4;
    FrameView view;
    view.world_from_car = {car_m, {1, 0, 0, 0}};
    view.viewport = {0, 0, width, height};
    view.projection = *off_axis_view(left, eye_m);
    input.views = {view};
    REQUIRE(renderer->draw(input).has_value());
    const double on_left = row_at_edge(*renderer->read_back(), true);
    input.views[0].projection = *off_axis_view(right, eye_m);
    REQUIRE(renderer->draw(input).has_value());
    const double on_right = row_at_edge(*renderer->read_back(), false);
    CHECK(std::abs(on_left - on_right) <= 1.0);
    MESSAGE("the line meets within ", std::abs(on_left - on_right), " px");
  }
  CHECK_MESSAGE(renderer->statistics().validation_messages == 0, renderer->statistics().first_validation_message);
}

}  // namespace septet::render
