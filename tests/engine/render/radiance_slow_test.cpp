/// Linear radiance of a frame before it becomes a picture, read back. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/light/tone_curve.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/ray_through.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/glowing_bar.hpp"
#include "tests/relative.hpp"

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

/// Wall, 800 m wide and high, of squares as large as those of distant land. It glows with `emission` and reflects no
/// light.
void upload_wall(Renderer& renderer, float emission, double away_m) {
  static std::uint64_t revision = 1;
  scene::SurfaceMaterial material = glowing_material();
  material.emission = glm::vec3(emission);
  scene::ResolvedScene scene = lone_mesh(material, wide_wall(), {Vec3(away_m, 0, 0), {1, 0, 0, 0}});
  scene.revision = ++revision;
  for (scene::SurfaceMesh& mesh : scene.meshes) mesh.revision = revision;
  REQUIRE(renderer.upload(scene).has_value());
}

/// Radiance in the middle of that wall, which fills the view.
glm::vec3 wall_radiance(Renderer& renderer, float emission, double away_m = 4.0) {
  upload_wall(renderer, emission, away_m);
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
      const glm::vec3 code = 255.0f * light::display_code(exposure * light.radiance[i]);
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
  CHECK((glaring - dark) / (bright - dark) == relative(1000.0, 0.002));
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
  CHECK(twice == relative(once * once, 0.02));
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
        // The sun's glare is drawn in the picture alone.
        if (glm::dot(ray, instant.light->sun_direction) < 0.9f)
          furthest = std::max(furthest, std::abs(drawn.g / said.g - 1.0) + std::abs(drawn.r / said.r - 1.0));
      }
    CHECK(furthest < 0.01);
  }
}

TEST_CASE("a hill in haze is as bright as the sky behind it with the sun at any height and on any side") {
  Renderer renderer = renderer_of(Antialiasing::none);
  upload_wall(renderer, 0.0f, 8000.0);
  for (const double elevation_rad : {-0.05, 0.03, 0.12, 0.75})
    for (double azimuth_rad = 0.26; azimuth_rad < 6.2; azimuth_rad += 0.52) {
      FrameInput input = forward(elevation_rad);
      input.environment.sun_azimuth_rad = azimuth_rad;
      input.environment.cloud_cover = 0.0;
      input.environment.visibility_m = 3000.0;
      const Instant instant = describe(input, {});
      REQUIRE(renderer.draw(instant).has_value());
      const RadianceImage light = *renderer.read_radiance();
      double darkest = 9.0, brightest = 0.0;
      for (std::uint32_t y = 0; y < radiance_height; ++y)
        for (std::uint32_t x = 0; x < radiance_width; ++x) {
          const glm::vec3 ray(ray_through(instant.views[0], x + 0.5, y + 0.5));
          if (ray.z < 0.02f || ray.z > 0.045f || std::abs(ray.y) > 0.045f) continue;
          for (int c = 0; c < 3; ++c) {
            const double share = light.at(x, y)[c] / sky_radiance(*instant.light, ray)[c];
            darkest = std::min(darkest, share);
            brightest = std::max(brightest, share);
          }
        }
      CAPTURE(elevation_rad);
      CAPTURE(azimuth_rad);
      CHECK(darkest > 0.9);
      CHECK(brightest < 1.1);
      CHECK(brightest > 0.0);
    }
}

TEST_CASE("what is near is not shaded by the coarser form that it has further off") {
  scene::SurfaceMaterial grey = glowing_material();
  grey.emission = glm::vec3(0.0f);
  grey.base_color = glm::vec3(0.5f);
  scene::SurfaceMesh board;
  for (const glm::vec3& corner : {glm::vec3(0, 2, -2), glm::vec3(0, -2, -2), glm::vec3(0, -2, 2), glm::vec3(0, 2, 2)})
    board.vertices.push_back({corner, {-1, 0, 0}, {}});
  board.indices = {0, 1, 2, 0, 2, 3};
  scene::ResolvedScene scene = lone_mesh(grey, board, {Vec3(8, 0, 1.2), {1, 0, 0, 0}});
  scene.prototypes = {{"model/board", std::move(scene.instances)}};
  scene.instances.clear();
  std::vector<scene::Instance>& forms = scene.prototypes[0].parts;
  forms[0].visible_to_m = 30.0f;
  const auto lit = [&] {
    Renderer renderer = renderer_of(Antialiasing::none);
    REQUIRE(renderer.upload(scene).has_value());
    FrameInput input = forward(0.4);
    input.environment.sun_azimuth_rad = 4.712389;  // In the west, behind the eye.
    input.environment.cloud_cover = 0.0;
    input.participants.resize(1);
    return shown(renderer, input).light.at(radiance_width / 2, radiance_height / 2).g;
  };
  const float alone = lit();
  // Higher than the ray to the board's middle, and between it and the sun.
  forms.push_back(forms[0]);
  forms[1].world_from_object.position_m += Vec3(-2.0, 0.0, 2.5);
  forms[1].visible_from_m = 30.0f;
  forms[1].visible_to_m = 1e9f;
  CHECK(lit() == alone);
  forms[1].visible_from_m = 0.0f;  // Once visible, it shades the board.
  CHECK(lit() < 0.6f * alone);
}

TEST_CASE("of several pictures in one image a participant shows that of its number") {
  scene::SurfaceMesh board;
  constexpr glm::vec2 corners[] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const glm::vec2& at : corners) board.vertices.push_back({{0, 2 - 4 * at.x, 2 - 4 * at.y}, {-1, 0, 0}, at});
  board.indices = {0, 2, 1, 0, 3, 2};
  scene::SurfaceMaterial material = glowing_material();
  material.base_color = glm::vec3(1.0f);
  material.emission = glm::vec3(1.0f);
  material.base_color_image = material.maps[scene::SurfaceMap::emission] = 0;
  material.picture_columns = 2;
  material.picture_rows = 2;
  scene::ResolvedScene scene = lone_mesh(material, board, {Vec3(8, 0, 1.2), {1, 0, 0, 0}});
  scene::TextureImage& image = scene.images.emplace_back();
  image.revision = 1;
  image.width = image.height = 64;
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      for (const int channel : {0, 1, 2, 3})
        image.rgba.push_back(channel == 3 || channel == static_cast<int>(x / 32 + 2 * (y / 32)) ? 255 : 0);
  scene.prototypes = {{"model/board", std::move(scene.instances)}};
  scene.instances.clear();
  Renderer renderer = renderer_of(Antialiasing::none);
  REQUIRE(renderer.upload(scene).has_value());
  FrameInput input = forward(0.4);
  input.participants.resize(1);
  for (std::uint32_t number = 0; number < 7; ++number) {
    input.participants[0].number = number;
    const glm::vec3 light = shown(renderer, input).light.at(radiance_width / 2, radiance_height / 2);
    CAPTURE(number);
    for (int c = 0; c < 3; ++c) CHECK((light[c] > 0.5f) == (c == static_cast<int>(number % 4)));
  }
}

TEST_CASE("a retroreflecting board shines back to the eye beside the lamp and not to one that stands aside") {
  scene::SurfaceMaterial sheeting = glowing_material();
  sheeting.emission = glm::vec3(0.0f);
  sheeting.base_color = glm::vec3(0.8f);
  scene::SurfaceMesh board;
  for (const glm::vec3& corner : {glm::vec3(0, 9, -2), glm::vec3(0, -9, -2), glm::vec3(0, -9, 5), glm::vec3(0, 9, 5)})
    board.vertices.push_back({corner, {-1, 0, 0}, {}});
  board.indices = {0, 1, 2, 0, 2, 3};
  const auto seen = [&](float retroreflection, double lamp_aside_m) {
    sheeting.retroreflection = retroreflection;
    Renderer renderer = renderer_of(Antialiasing::none);
    REQUIRE(renderer.upload(lone_mesh(sheeting, board, {Vec3(100, 0, 1.2), {1, 0, 0, 0}})).has_value());
    FrameInput input = forward(-0.3);
    Instant instant = describe(input, {});
    const Vec3 eye = world_eye(input.views[0]);
    instant.headlights = {{eye + Vec3(2.0, lamp_aside_m, -0.5), {1, 0, 0}, 100.0f}};
    REQUIRE(renderer.draw(instant).has_value());
    return renderer.read_radiance()->at(radiance_width / 2, radiance_height / 2).g;
  };
  const float matt = seen(0.0f, 0.0), beside = seen(180.0f, 0.0), aside = seen(180.0f, 8.0);
  CHECK(beside > 20.0f * matt);
  CHECK(aside < 0.1f * beside);
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
  CHECK(light(four) == relative(light(one), 0.05));
}

}  // namespace septet::render
