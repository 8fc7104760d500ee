/// Pictures of the reference scene for people to look at; they lie in the build folder below images/.

#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t picture_width = 960, picture_height = 540;

void save(const image::Image& picture, const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(build_folder()) / "images";
  std::filesystem::create_directories(folder);
  CHECK(image::write_png(folder / (name + ".png"), picture).has_value());
}

FrameInput traffic(const ReferenceScene& reference, Lamps lamps) {
  FrameInput input;
  input.environment = reference_day();
  input.views = {forward_view({0, -1.875, 0}, picture_width, picture_height)};
  const glm::vec3 paints[] = {
      {0.34f, 0.022f, 0.026f}, {0.8f, 0.8f, 0.79f}, {0.05f, 0.11f, 0.3f}, {0.02f, 0.02f, 0.02f}};
  const double places[][2] = {{11, -5.6}, {20, 1.9}, {34, -1.9}, {60, 5.6}, {85, -5.6}, {110, -1.9}};
  for (std::size_t i = 0; i < 6; ++i) {
    DrawnParticipant car = reference_car(reference, {places[i][0], places[i][1], 0.02});
    car.paint = paints[i % 4];
    car.lamps = lamps;
    if (i == 1) car.lamps.set(Lamp::brake, true);
    if (i == 2) car.lamps.set(Lamp::beacon, true);
    input.participants.push_back(car);
  }
  return input;
}

}  // namespace

TEST_CASE(
    "the reference scene by day and dusk and night in rain and in a tunnel draws without a word of the validation "
    "layer") {
  Expected<Renderer> renderer = Renderer::create(
      {picture_width, picture_height, DevicePreference::software, true, Antialiasing::automatic, nullptr});
  REQUIRE(renderer.has_value());
  ReferenceOptions options;
  ReferenceScene reference = reference_scene(options);
  REQUIRE(renderer->upload(reference.scene).has_value());
  Lamps beams;
  beams.set(Lamp::low_beam, true);
  FrameInput input = traffic(reference, {});
  input.overlay.push_back({"Septet  104 km/h", 12, 10, 22, {1, 1, 1, 1}, {0, 0, 0, 0.45f}});
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "day");
  MESSAGE("triangles ", renderer->statistics().triangles, " shadows ", renderer->statistics().shadow_triangles,
          " draws ", renderer->statistics().draws);
  input.overlay.clear();
  input.views[0].projection = symmetric_view({1.2, 0.35, 1.2}, 1.4, 0.15, 1.05, 0.64);
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "side");

  input = traffic(reference, beams);
  input.environment.sun_elevation_rad = 0.05;
  input.environment.sun_azimuth_rad = 1.2;
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "low_sun");
  input.environment.sun_elevation_rad = -0.3;
  DrawnParticipant own = reference_car(reference, {0, -1.875, 0});
  own.lamps = beams;
  own.shown = Shown::shadow_and_light;
  input.participants.push_back(own);
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "night");
  input = traffic(reference, beams);
  input.environment.cloud_cover = 1.0;
  input.environment.road_wetness = 0.9;
  input.environment.visibility_m = 1500.0;
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "rain");

  options.tunnel = true;
  reference = reference_scene(options);
  reference.scene.revision = 2;
  for (scene::SurfaceMesh& mesh : reference.scene.meshes) mesh.revision = 2;
  REQUIRE(renderer->upload(reference.scene).has_value());
  input = traffic(reference, beams);
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "tunnel_ahead");
  for (DrawnParticipant& car : input.participants) car.world_from_vehicle.position_m.x += 150.0;
  input.views = {forward_view({150, -1.875, 0}, picture_width, picture_height)};
  REQUIRE(renderer->draw(input).has_value());
  save(*renderer->read_back(), "tunnel");

  CHECK_MESSAGE(renderer->statistics().validation_messages == 0, renderer->statistics().first_validation_message);
}

}  // namespace septet::render
