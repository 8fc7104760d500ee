/// A straight line drawn across two screens that share an edge, read back from their pixels.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/render/glowing_bar.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t seam_width = 640, seam_height = 420;
const Vec3 car_m(100e3, -80e3, 35.0);

/// A glowing bar 12 m ahead of the car, 16 m long, that rises to one side.
scene::ResolvedScene bar_scene() {
  scene::SurfaceMesh bar;
  for (std::uint16_t i = 0; i < bar_corners; ++i) bar.vertices.push_back({glm::vec3(bar_corner_m(i)), {-1, 0, 0}, {}});
  for (const auto& triangle : bar_triangles) bar.indices.insert(bar.indices.end(), triangle.begin(), triangle.end());
  return lone_mesh(glowing_material(), bar, {car_m + Vec3(12, 0, 2.2), orientation_from_angles(0.0, 0.0, 0.07)});
}

}  // namespace

TEST_CASE("a straight line drawn across two screens meets within a pixel from wherever the eye looks") {
  Expected<Renderer> renderer =
      Renderer::create({seam_width, seam_height, DevicePreference::software, true, Antialiasing::automatic, nullptr});
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
    view.viewport = {0, 0, seam_width, seam_height};
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
