/// Light of standing lamps on the ground at night. Software device, validation layer on.

#include <cstdint>

#include <doctest/doctest.h>

#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

/// Level grey ground, 200 m wide, below three lenses in a row at 20, 50 and 80 m ahead, 6 m high.
scene::ResolvedScene lit_ground() {
  scene::SurfaceMaterial grey;
  grey.base_color = glm::vec3(0.2f);
  grey.roughness = 1.0f;
  scene::SurfaceMesh ground;
  for (const glm::vec2 corner : {glm::vec2(-100), glm::vec2(100, -100), glm::vec2(100), glm::vec2(-100, 100)})
    ground.vertices.push_back({glm::vec3(corner, 0.0f), {0, 0, 1}, {}});
  ground.indices = {0, 1, 2, 0, 2, 3};
  scene::ResolvedScene scene = instant::lone_mesh(grey, ground, {Vec3(0.0), {1, 0, 0, 0}});
  scene::SurfaceMaterial shining = grey;
  shining.emission = glm::vec3(0.8f);
  shining.revision = 1;
  scene.materials.push_back(shining);
  scene::SurfaceMesh lens;
  for (const glm::vec2 corner : {glm::vec2(0), glm::vec2(0, 0.3f), glm::vec2(0.4f, 0.3f), glm::vec2(0.4f, 0)})
    lens.vertices.push_back({{corner.x, corner.y, 6.0f}, {0, 0, -1}, {}});
  lens.indices = {0, 1, 2, 0, 2, 3};
  lens.parts = {{0, 6, 1}};
  lens.bounds_max_m = {0.4f, 0.3f, 6.0f};
  lens.revision = 1;
  scene.meshes.push_back(lens);
  for (const double ahead_m : {20.0, 50.0, 80.0}) {
    scene::Instance lamp;
    lamp.mesh = 1;
    lamp.world_from_object = {Vec3(ahead_m, 0, 0), {1, 0, 0, 0}};
    scene.instances.push_back(lamp);
  }
  return scene;
}

constexpr std::uint32_t lamps_width = 320, lamps_height = 200;

/// Radiance of the ground so far ahead.
float ground_at(const RadianceImage& light, const FrameView& view, double ahead_m) {
  const double eye_m = world_eye(view).z;
  const double down = (view.projection.top_slope + eye_m / (ahead_m - world_eye(view).x)) /
                      (view.projection.top_slope - view.projection.bottom_slope);
  return light.at(lamps_width / 2, static_cast<std::uint32_t>(down * lamps_height)).g;
}

}  // namespace

TEST_CASE("street lamps throw pools on the road by night and none that is seen by day") {
  Renderer renderer =
      *Renderer::create({lamps_width, lamps_height, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(lit_ground()).has_value());
  FrameInput input;
  input.environment = instant::reference_day();
  input.views = {instant::forward_view({0, 0, 6}, lamps_width, lamps_height)};
  const auto pools = [&] {
    REQUIRE(renderer.draw(input).has_value());
    CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
    const RadianceImage light = *renderer.read_radiance();
    return ground_at(light, input.views[0], 80.0) / ground_at(light, input.views[0], 65.0);
  };
  CHECK(pools() == relative(1.0f, 0.03));
  input.environment.sun_elevation_rad = -0.4;
  input.environment.sun_illuminance_lux = 0.0;
  const float by_night = pools();
  CAPTURE(by_night);
  CHECK(by_night > 3.0f);
  // The eye goes on and the field with it: the pools stay where they are.
  const RadianceImage before = *renderer.read_radiance();
  input.views = {instant::forward_view({26, 0, 6}, lamps_width, lamps_height)};
  REQUIRE(renderer.draw(input).has_value());
  const RadianceImage after = *renderer.read_radiance();
  CHECK(ground_at(after, input.views[0], 80.0) / ground_at(after, input.views[0], 65.0) == relative(by_night, 0.1));
}

}  // namespace septet::render
