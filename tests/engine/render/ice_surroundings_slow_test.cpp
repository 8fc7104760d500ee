/// Reflections of ice in several places, and thin ice over a road. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/ice/objects.hpp"
#include "engine/effects/ice/still_ice.hpp"
#include "engine/render/renderer.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t plates_width = 320, plates_height = 200;

/// Plates that shine, in three colours: their meshes are 0 to 2.
scene::ResolvedScene scene_of_plates() {
  scene::ResolvedScene scene;
  scene.revision = 1;
  for (const glm::vec3 colour : {glm::vec3(6.0f, 0.0f, 0.0f), {0.0f, 6.0f, 0.0f}, {0.2f, 0.2f, 0.2f}}) {
    scene::SurfaceMaterial material;
    material.revision = 1;
    material.base_color = glm::vec3(0.0f);
    material.emission = colour;
    scene::SurfaceMesh plate;
    plate.revision = 1;
    for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      plate.vertices.push_back({{at.x, at.y, 0.0f}, {0, 0, 1}, {}});
    plate.indices = {0, 1, 2, 0, 2, 3};
    plate.parts = {{0, 6, static_cast<std::uint32_t>(scene.materials.size())}};
    plate.bounds_min_m = {-1, -1, 0};
    plate.bounds_max_m = {1, 1, 0};
    scene.materials.push_back(material);
    scene.meshes.push_back(plate);
  }
  return scene;
}

void lay_plate(scene::ResolvedScene& scene, std::uint32_t mesh, const Vec3& middle_m, float half_m) {
  scene::Instance instance;
  instance.mesh = mesh;
  instance.world_from_object.position_m = middle_m;
  instance.scale = {half_m, half_m, 1.0f};
  scene.instances.push_back(instance);
}

/// View from 1.2 m over the world's origin along x.
FrameInput over_plates() {
  FrameInput input;
  input.environment.sun_elevation_rad = 0.8;
  FrameView view;
  view.projection =
      symmetric_view(Vec3(0.0), 0.0, 0.0, 0.9, 2.0 * std::atan(std::tan(0.45) * plates_height / plates_width));
  view.world_from_car.position_m = {0.0, 0.0, 1.2};
  view.viewport = {0, 0, plates_width, plates_height};
  input.views = {view};
  input.ice_surroundings_px = 32;
  return input;
}

ice::IceBody ball_at(const Vec3& origin_m, float scale) {
  ice::IceBody body;
  body.origin_m = origin_m;
  body.vertices = ice::sphere();
  for (ice::IceVertex& vertex : body.vertices) vertex.position_m *= scale;
  body.look.bump = 0.0f;
  return body;
}

RadianceImage light_over_plates(Renderer& renderer, const FrameInput& input) {
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return *renderer.read_radiance();
}

}  // namespace

TEST_CASE("ice on a roof mirrors what is around the roof while other ice lies nearer on the road") {
  auto renderer =
      Renderer::create({plates_width, plates_height, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.has_value());
  scene::ResolvedScene scene = scene_of_plates();
  const Vec3 roof_m(14.0, 3.0, 3.2), road_m(6.0, -1.5, 0.3);
  lay_plate(scene, 0, roof_m - Vec3(0, 0, 0.6), 2.0f);
  lay_plate(scene, 1, road_m - Vec3(0, 0, 0.3), 2.0f);
  REQUIRE(renderer->upload(scene).has_value());
  FrameInput input = over_plates();
  input.ice = {ball_at(roof_m, 1.0f)};
  const RadianceImage alone = light_over_plates(*renderer, input);
  input.ice.clear();
  const RadianceImage none = light_over_plates(*renderer, input);
  input.ice = {ball_at(road_m, 0.3f), ball_at(roof_m, 1.0f)};
  const RadianceImage both = light_over_plates(*renderer, input);
  int of_roof = 0, of_road = 0;
  int red = 0;
  double difference = 0.0, road_green = 0.0;
  for (std::uint32_t y = 0; y < plates_height; ++y)
    for (std::uint32_t x = 0; x < plates_width; ++x) {
      const glm::vec3 a = alone.at(x, y), n = none.at(x, y), b = both.at(x, y);
      if (glm::length(a - n) > 1e-4f) {
        ++of_roof;
        difference += glm::length(b - a) / std::max(glm::length(a), 1e-3f);
        red += b.r > 1.3f * b.g;
      } else if (glm::length(b - n) > 1e-4f) {
        ++of_road;
        road_green += b.g > 1.2f * b.r;
      }
    }
  CAPTURE(of_roof);
  CAPTURE(of_road);
  CHECK(of_roof > 300);
  CHECK(of_road > 200);
  CHECK(difference / of_roof < 0.01);
  CHECK(red > 0.05 * of_roof);
  CHECK(road_green > 0.2 * of_road);
  MESSAGE("ice on the roof differs by " << 100.0 * difference / of_roof << " % for the other's sake");
}

TEST_CASE(
    "through thin ice a road is seen in its place and darker, and at a glancing look the ice mirrors what is ahead") {
  auto renderer =
      Renderer::create({plates_width, plates_height, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.has_value());
  scene::ResolvedScene scene = scene_of_plates();
  // Grey road with a red mark across, which ends at the place where thin ice is measured.
  lay_plate(scene, 2, {30.0, 0.0, 0.0}, 29.0f);
  lay_plate(scene, 0, {6.0, 0.0, 0.002}, 0.5f);
  REQUIRE(renderer->upload(scene).has_value());
  FrameInput input = over_plates();
  const RadianceImage bare = light_over_plates(*renderer, input);
  ice::IceBody sheet;
  sheet.look.thin = true;
  sheet.look.bump = 0.0f;
  sheet.origin_m = {30.0, 0.0, 0.012};
  sheet.vertices = ice::box_surface({-27.0, -2.0, -0.002}, {27.0, 2.0, 0.002}, 20, 2);
  input.ice = {sheet};
  const RadianceImage iced = light_over_plates(*renderer, input);
  const auto row_at = [&](double distance_m) {
    const double slope = 1.2 / distance_m, per_px = 2.0 * std::tan(0.45) / plates_width;
    return static_cast<std::uint32_t>(0.5 * plates_height + slope / per_px);
  };
  // The mark's edges lie in the same pixels, and it is darker by the same share everywhere.
  int moved = 0, marked = 0;
  for (std::uint32_t y = row_at(7.0); y < row_at(5.0); ++y)
    for (std::uint32_t x = 120; x < 200; ++x) {
      const auto is_red = [](const glm::vec3& c) { return c.r > 2.0f * c.g; };
      marked += is_red(bare.at(x, y));
      moved += is_red(bare.at(x, y)) != is_red(iced.at(x, y));
    }
  CHECK(marked > 100);
  CHECK(moved == 0);
  const float near_share = iced.at(160, row_at(5.0)).g / bare.at(160, row_at(5.0)).g;
  CHECK(near_share < 1.0f);
  // Towards the horizon the sky takes over.
  const glm::vec3 sky = bare.at(160, 25), far = iced.at(160, row_at(50.0)), road = bare.at(160, row_at(50.0));
  CHECK(glm::length(far - road) > 0.25f * glm::length(sky - road));
  CHECK(glm::length(far - road) < 0.9f * glm::length(sky - road));
  MESSAGE("near by " << near_share << " of the road's light; 50 m off "
                     << glm::length(far - road) / glm::length(sky - road) << " of the way to the sky's");
}

}  // namespace septet::render
