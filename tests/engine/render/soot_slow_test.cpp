/// Soot on a wall, read back from its pixels: covered parts are dark, others unchanged.

#include <cmath>
#include <utility>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t soot_width = 320, soot_height = 240;
const Vec3 soot_car_m(3e3, -2e3, 12.0);

/// A white wall 8 m ahead of the car, 40 m wide and 20 m high, seen square on.
scene::ResolvedScene wall_scene() {
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(0.8f);
  scene::SurfaceMesh wall;
  for (const glm::vec3& corner :
       {glm::vec3(0, 20, -10), glm::vec3(0, -20, -10), glm::vec3(0, -20, 10), glm::vec3(0, 20, 10)})
    wall.vertices.push_back({corner, {-1, 0, 0}, {}});
  wall.indices = {0, 1, 2, 0, 2, 3};
  return lone_mesh(white, wall, {soot_car_m + Vec3(8, 0, 0), {1, 0, 0, 0}});
}

/// 4 m of soot on the wall's left half beside the middle, turned with a tunnel.
SootField soot_field(std::uint8_t cover) {
  SootField soot;
  soot.nx = 8, soot.ny = 6, soot.nz = 6;
  soot.cover.assign(8 * 6 * 6, 0);
  for (int k = 1; k < 5; ++k)
    for (int j = 1; j < 5; ++j)
      for (int i = 1; i < 7; ++i) soot.cover[static_cast<std::size_t>((k * 6 + j) * 8 + i)] = cover;
  const Quat turn = orientation_from_angles(0.3, 0.0, 0.0);
  soot.world_from_field = {soot_car_m + Vec3(8, 3, 1.2) - turn * Vec3(4, 3, 3), turn};
  return soot;
}

/// Mean of a square of pixels whose middle lies at y and z of the wall.
double light_at(const image::Image& picture, double y_m, double z_m) {
  const double pixels_per_m = 0.5 * soot_width / (8.0 * std::tan(0.5));
  const auto x = static_cast<std::uint32_t>(0.5 * soot_width - y_m * pixels_per_m);
  const auto y = static_cast<std::uint32_t>(0.5 * soot_height - (z_m - 1.2) * pixels_per_m);
  double sum = 0.0;
  for (std::uint32_t dy = 0; dy < 5; ++dy)
    for (std::uint32_t dx = 0; dx < 5; ++dx) sum += picture.at(x + dx - 2, y + dy - 2).green;
  return sum / 25.0;
}

}  // namespace

TEST_CASE("soot darkens the wall where it lies and nowhere else") {
  Expected<Renderer> renderer =
      Renderer::create({soot_width, soot_height, DevicePreference::software, true, Antialiasing::automatic, nullptr});
  REQUIRE(renderer.has_value());
  REQUIRE(renderer->upload(wall_scene()).has_value());
  FrameInput input;
  input.environment = reference_day();
  FrameView view;
  view.projection =
      symmetric_view({0, 0, 1.2}, 0.0, 0.0, 1.0, 2.0 * std::atan(std::tan(0.5) * soot_height / soot_width));
  view.world_from_car.position_m = soot_car_m;
  view.viewport = {0, 0, soot_width, soot_height};
  input.views = {view};
  const auto drawn = [&] {
    REQUIRE(renderer->draw(input).has_value());
    return *renderer->read_back();
  };
  const image::Image clean = drawn();
  input.soot = soot_field(128);
  const image::Image half = drawn();
  input.soot = soot_field(250);
  const image::Image full = drawn();
  CHECK(light_at(clean, 3.0, 1.2) > 100.0);
  CHECK(light_at(half, 3.0, 1.2) < 0.9 * light_at(clean, 3.0, 1.2));
  CHECK(light_at(full, 3.0, 1.2) < 0.4 * light_at(clean, 3.0, 1.2));
  CHECK(light_at(full, 3.0, 0.2) < 0.4 * light_at(clean, 3.0, 0.2));
  for (const auto& [y, z] : {std::pair{-2.5, 1.2}, std::pair{3.0, 4.3}, std::pair{-3.5, -1.0}})
    CHECK(light_at(full, y, z) == doctest::Approx(light_at(clean, y, z)));
  CHECK_MESSAGE(renderer->statistics().validation_messages == 0, renderer->statistics().first_validation_message);
}

}  // namespace septet::render
