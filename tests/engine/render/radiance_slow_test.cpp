/// The linear radiance that a frame's picture is made from, read back. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/instant/tone_curve.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/glowing_bar.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t radiance_width = 320, radiance_height = 200;

struct Drawn {
  image::Image picture;
  RadianceImage light;
  float exposure = 0.0f;
};

Renderer renderer_of(Antialiasing antialiasing) {
  return *Renderer::create({radiance_width, radiance_height, DevicePreference::software, true, antialiasing, nullptr});
}

Drawn shown(Renderer& renderer, const FrameInput& input) {
  REQUIRE(renderer.draw(input).has_value());
  Drawn result{*renderer.read_back(), *renderer.read_radiance(), renderer.exposure().scale()};
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return result;
}

FrameInput forward(double elevation_rad) {
  FrameInput input;
  input.environment = reference_day();
  input.environment.sun_elevation_rad = elevation_rad;
  input.views = {forward_view({0, 0, 0}, radiance_width, radiance_height)};
  return input;
}

/// Radiance in the middle of a wall that glows with `emission` and fills the view, seen from `away_m`.
glm::vec3 wall_radiance(Renderer& renderer, float emission, double away_m = 4.0) {
  static std::uint64_t revision = 1;
  scene::SurfaceMaterial material = glowing_material();
  material.emission = glm::vec3(emission);
  scene::SurfaceMesh wall;
  for (const glm::vec3& corner :
       {glm::vec3(0, 400, -400), glm::vec3(0, -400, -400), glm::vec3(0, -400, 400), glm::vec3(0, 400, 400)})
    wall.vertices.push_back({corner, {-1, 0, 0}, {}});
  wall.indices = {0, 1, 2, 0, 2, 3};
  scene::ResolvedScene scene = lone_mesh(material, wall, {Vec3(away_m, 0, 0), {1, 0, 0, 0}});
  scene.revision = ++revision;
  for (scene::SurfaceMesh& mesh : scene.meshes) mesh.revision = revision;
  REQUIRE(renderer.upload(scene).has_value());
  return shown(renderer, forward(0.9)).light.at(radiance_width / 2, radiance_height / 2);
}

}  // namespace

TEST_CASE("the picture is the radiance after exposure and the tone curve at every pixel by day and by night") {
  const ReferenceScene reference = reference_scene({{}, false, 40});
  Renderer renderer = renderer_of(Antialiasing::none);
  REQUIRE(renderer.upload(reference.scene).has_value());
  for (const double elevation_rad : {0.8, -0.3}) {
    FrameInput input = forward(elevation_rad);
    input.participants = {reference_car(reference, {12, 2, 0})};
    input.participants[0].lamps.set(Lamp::brake, true);
    const auto [picture, light, exposure] = shown(renderer, input);
    int most = 0;
    for (std::size_t i = 0; i < light.radiance.size(); ++i) {
      const glm::vec3 code = 255.0f * display_code(exposure * light.radiance[i]);
      for (int c = 0; c < 3; ++c)
        most = std::max(
            most, std::abs(static_cast<int>(std::lround(code[c])) - picture.rgba[4 * i + static_cast<std::size_t>(c)]));
    }
    CHECK(most <= 1);
  }
}

TEST_CASE(
    "a wall that gives off a thousand times as much light has a thousand times the radiance though both are white") {
  Renderer renderer = renderer_of(Antialiasing::automatic);
  const float dark = wall_radiance(renderer, 0.0f).g, bright = wall_radiance(renderer, 20.0f).g,
              glaring = wall_radiance(renderer, 20000.0f).g;
  CHECK((glaring - dark) / (bright - dark) == doctest::Approx(1000.0).epsilon(0.002));
}

TEST_CASE("smoke of optical depth one before a wall leaves the share of its radiance that Beer and Lambert say") {
  Renderer renderer = renderer_of(Antialiasing::none);
  const float behind = wall_radiance(renderer, 20.0f, 40.0).g;
  FrameInput input = forward(0.9);
  const auto with_smoke = [&](float depth) {
    SmokePuff puff;
    puff.position_m = Vec3(20, 0, 0) + input.views[0].projection.eye_m;
    puff.radius_m = 3.0f;
    puff.albedo = glm::vec3(0.0f);
    puff.extinction_area_m2 = depth * 2.0f * 3.14159265f * 9.0f;
    input.smoke = {puff};
    return shown(renderer, input).light.at(radiance_width / 2, radiance_height / 2).g;
  };
  // The pattern of the smoke varies the depth; twice the smoke has twice that depth wherever it is.
  const float once = with_smoke(0.5f) / behind, twice = with_smoke(1.0f) / behind;
  CHECK(once < 0.85f);
  CHECK(once > 0.35f);
  CHECK(twice == doctest::Approx(once * once).epsilon(0.02));
}

TEST_CASE(
    "the sky that is drawn has at every pixel the radiance that the description says for its ray, in a mirror too") {
  Renderer renderer = renderer_of(Antialiasing::none);
  const ReferenceScene reference = reference_scene({{}, false, 0});
  REQUIRE(renderer.upload(reference.scene).has_value());
  for (const bool mirrored : {false, true}) {
    FrameInput input = forward(0.8);
    input.environment.cloud_cover = 0.0;
    input.views[0].projection = symmetric_view({1.2, 0.35, 1.2}, -0.6, 0.5, 1.05, 0.64);
    input.views[0].mirrored = mirrored;
    const Instant instant = describe(input, summarise(reference.scene));
    REQUIRE(renderer.draw(instant).has_value());
    const RadianceImage light = *renderer.read_radiance();
    double furthest = 0.0;
    for (std::uint32_t y = 0; y < radiance_height / 2; y += 7)
      for (std::uint32_t x = 0; x < radiance_width; x += 5) {
        const glm::vec3 ray(ray_through(instant.views[0], x + 0.5, y + 0.5));
        const glm::vec3 said = sky_radiance(*instant.light, ray), drawn = light.at(x, y);
        // The sun's glare is the picture's own.
        if (glm::dot(ray, instant.light->sun_direction) < 0.9f)
          furthest = std::max(furthest, std::abs(drawn.g / said.g - 1.0) + std::abs(drawn.r / said.r - 1.0));
      }
    CHECK(furthest < 0.01);
  }
}

TEST_CASE("two screens of a rig and a mirror in one of them are exposed alike") {
  const ReferenceScene reference = reference_scene({{}, true, 0});
  Renderer renderer = renderer_of(Antialiasing::automatic);
  REQUIRE(renderer.upload(reference.scene).has_value());
  // Half under the tunnel's roof, where adaptation is under way.
  FrameInput input = forward(0.8);
  input.views[0].world_from_car.position_m.x = 105.0;
  const float ahead = shown(renderer, input).exposure;
  input.views[0].projection = symmetric_view({1.2, 0.35, 1.2}, 2.4, 0.0, 1.05, 0.64);
  const float behind = shown(renderer, input).exposure;
  input.views.push_back(input.views[0]);
  input.views[1].viewport = {200, 10, 100, 40};
  const float with_mirror = shown(renderer, input).exposure;
  CHECK(ahead == behind);
  CHECK(ahead == with_mirror);
  input.views[0].world_from_car.position_m.x = 20.0;
  CHECK(shown(renderer, input).exposure < 0.9f * ahead);
}

TEST_CASE(
    "with four samples a pixel the edge of a glaring bar takes codes between dark and white and the radiance read is "
    "the samples' mean") {
  scene::SurfaceMesh bar;
  for (std::uint16_t i = 0; i < bar_corners; ++i) bar.vertices.push_back({glm::vec3(bar_corner_m(i)), {-1, 0, 0}, {}});
  for (const auto& triangle : bar_triangles) bar.indices.insert(bar.indices.end(), triangle.begin(), triangle.end());
  const scene::ResolvedScene scene =
      lone_mesh(glowing_material(), bar, {{12, 0, 2.2}, orientation_from_angles(0.0, 0.0, 0.07)});
  const auto drawn = [&](Antialiasing antialiasing) {
    Renderer renderer = renderer_of(antialiasing);
    REQUIRE(renderer.upload(scene).has_value());
    return shown(renderer, forward(-0.4));
  };
  const auto between = [](const Drawn& frame) {
    int count = 0;
    for (std::size_t i = 0; i < frame.picture.rgba.size(); i += 4)
      count += frame.picture.rgba[i] > 50 && frame.picture.rgba[i] < 220;
    return count;
  };
  const auto light = [](const Drawn& frame) {
    double sum = 0.0;
    for (const glm::vec3& radiance : frame.light.radiance) sum += radiance.g;
    return sum;
  };
  const Drawn one = drawn(Antialiasing::none), four = drawn(Antialiasing::multisampled);
  CHECK(between(four) > between(one) + 100);
  CHECK(light(four) == doctest::Approx(light(one)).epsilon(0.05));
}

}  // namespace septet::render
