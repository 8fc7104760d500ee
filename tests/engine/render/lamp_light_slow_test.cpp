/// Light of a lamp that arrives in a picture, by distance and over a wet road, and its attenuation in the air. Software
/// device, validation layer on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/light/lamplight.hpp"
#include "engine/light/tone_curve.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/glowing_bar.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

/// Pixels as those of a screen of 1080 lines over 40 degrees.
constexpr std::uint32_t side_px = 160;
constexpr double pixel_rad = 1.0 / 1484.0;

/// Pixels `taller` times as high as they are wide.
FrameInput close_up(double sun_elevation_rad, double pixel = pixel_rad, double taller = 1.0) {
  FrameInput input;
  input.environment = instant::reference_day();
  input.environment.sun_elevation_rad = sun_elevation_rad;
  if (sun_elevation_rad < 0.0) input.environment.sun_illuminance_lux = 0.0;
  FrameView view;
  const double across_rad = 2.0 * std::atan(0.5 * side_px * pixel);
  const double up_rad = 2.0 * std::atan(0.5 * side_px * pixel * taller);
  view.projection = instant::symmetric_view({0.0, 0.0, 1.2}, 0.0, 0.0, across_rad, up_rad);
  view.viewport = {0, 0, side_px, side_px};
  input.views = {view};
  return input;
}

/// A square that glows, in the plane x = `ahead_m`.
scene::ResolvedScene square(double ahead_m, double up_m, float half_m, const glm::vec3& emission,
                            float share_of_sky = 1.0f) {
  scene::SurfaceMaterial material = glowing_material();
  material.emission = emission;
  material.share_of_sky = share_of_sky;
  scene::SurfaceMesh mesh;
  for (const glm::vec2 corner : {glm::vec2(1, -1), glm::vec2(-1, -1), glm::vec2(-1, 1), glm::vec2(1, 1)})
    mesh.vertices.push_back({glm::vec3(0.0f, half_m * corner), {-1, 0, 0}, {}});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  return instant::lone_mesh(material, mesh, {Vec3(ahead_m, 0.0, up_m), {1, 0, 0, 0}});
}

Renderer renderer_for(const scene::ResolvedScene& scene) {
  Renderer renderer =
      *Renderer::create({side_px, side_px, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  return renderer;
}

RadianceImage drawn(Renderer& renderer, const Instant& instant) {
  REQUIRE(renderer.draw(instant).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  return *renderer.read_radiance();
}

/// Excess of radiance in `with` over `without`, over all pixels.
glm::dvec3 more(const RadianceImage& with, const RadianceImage& without) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t y = 0; y < side_px; ++y)
    for (std::uint32_t x = 0; x < side_px; ++x) sum += glm::dvec3(with.at(x, y)) - glm::dvec3(without.at(x, y));
  return sum;
}

instant::LampGlow tail_lamp(double ahead_m) {
  instant::LampGlow lamp;
  lamp.position_m = {ahead_m, 0.0, 0.7};
  lamp.facing = {-1, 0, 0};
  lamp.color = {0.55f, 0.02f, 0.012f};
  lamp.radius_m = 0.22f;
  return lamp;
}

}  // namespace

TEST_CASE(
    "by night a lamp's light falls with the square of its distance from fifty to five hundred metres, and at the "
    "furthest a tail lamp is still a bright point") {
  std::vector<double> by_square;
  for (const double ahead_m : {50.0, 75.0, 100.0, 200.0, 350.0, 500.0}) {
    FrameInput input = close_up(-0.4);
    input.environment.visibility_m = 200e3;
    // Lens itself, of the area that the glow assumes.
    Renderer renderer = renderer_for(square(ahead_m, 0.7, 0.0798f, {0.55f, 0.02f, 0.012f}));
    Instant instant = instant::describe(input, {});
    instant.lamps = {tail_lamp(ahead_m)};
    const RadianceImage lit = drawn(renderer, instant);
    instant.lamps.clear();
    REQUIRE(renderer.upload(square(ahead_m, -500.0, 0.0798f, glm::vec3(0.0f))).has_value());
    const RadianceImage dark = drawn(renderer, instant);
    by_square.push_back(more(lit, dark).r * ahead_m * ahead_m);
    float brightest = 0.0f;
    for (const glm::vec3& pixel : lit.radiance) brightest = std::max(brightest, pixel.r);
    CHECK(light::display_code(glm::vec3(brightest * instant.exposure.scale())).r > 0.78f);
  }
  for (const double each : by_square) {
    CAPTURE(each);
    CAPTURE(by_square[3]);
    CHECK(each == relative(by_square[3], 0.15));
  }
}

TEST_CASE("rain and snow take as much of a picture's contrast as is computed of them, and under a roof none") {
  Renderer renderer = renderer_for(square(500.0, -24.0, 30.0f, glm::vec3(0.0f)));
  const auto contrast = [&](double mm_per_h, double temperature_k, float share_of_sky) {
    FrameInput input = close_up(0.8);
    input.environment.cloud_cover = 1.0;
    input.environment.visibility_m = 200e3;
    input.environment.rain_mm_per_h = mm_per_h;
    input.environment.temperature_k = temperature_k;
    Instant instant = instant::describe(input, {});
    instant.extinction_per_m = instant.light->fog_per_m + share_of_sky * instant.light->fall_per_m;
    instant.environment.rain_mm_per_h = 0.0;  // Without drops before the eye.
    const glm::vec3 behind = instant::sky_radiance(*instant.light, {0.9998f, 0.0f, 0.02f});
    return 1.0 - double(drawn(renderer, instant).at(side_px / 2, side_px / 2).g / behind.g);
  };
  const double dry = contrast(0.0, 283.0, 1.0f);
  CHECK(dry == relative(std::exp(-3.912 * 500.0 / 200e3), 0.01));
  for (const double mm_per_h : {2.5, 10.0, 50.0}) {
    CAPTURE(mm_per_h);
    CHECK(contrast(mm_per_h, 283.0, 1.0f) / dry == relative(std::exp(-0.312 * std::pow(mm_per_h, 0.67) * 0.5), 0.01));
  }
  // Moderate snowfall, seen through half a kilometre to one.
  const double snow = contrast(2.0, 265.0, 1.0f) / dry;
  CHECK(std::log(snow) == relative(-0.5 * 5.50 / 4.343 * std::pow(2.0, 1.38), 0.02));
  CHECK(contrast(50.0, 283.0, 0.0f) == relative(dry, 0.01));
}

TEST_CASE("haze in a tunnel is lit by its lamps and not by the sky, and beyond its mouth by the sky") {
  Renderer renderer = renderer_for(square(200.0, -9.0, 12.0f, glm::vec3(0.0f), 0.0f));
  Instant instant = instant::describe(close_up(0.8), {});
  instant.extinction_per_m = 0.005f;
  const auto haze = [&](float eye_share_of_sky) {
    instant.share_of_sky = eye_share_of_sky;
    return drawn(renderer, instant).at(side_px / 2, side_px / 2) / (1.0f - std::exp(-1.0f));
  };
  const glm::vec3 within = haze(0.0f), before = haze(1.0f);
  CHECK(glm::distance(within, light::roofed_haze) < 0.01f * glm::length(light::roofed_haze));
  CHECK(within.r > 1.3f * within.b);
  CHECK(glm::distance(before, instant::sky_radiance(*instant.light, {0.9998f, 0.0f, 0.02f})) < 0.02f);
}

TEST_CASE("a wet road sends on as much of a lamp's light as water mirrors, in a streak as long as its slopes make it") {
  for (const double ahead_m : {20.0, 50.0}) {
    CAPTURE(ahead_m);
    Renderer renderer = renderer_for(square(ahead_m, -500.0, 0.1f, glm::vec3(0.0f)));
    // Picture as high as the streak is long, nearly to the eye's feet.
    constexpr double pixel_m = 0.07, taller = 2.0;
    FrameInput input = close_up(-0.4, pixel_m / ahead_m, taller);
    input.environment.visibility_m = 200e3;
    Instant instant = instant::describe(input, {});
    const RadianceImage dark = drawn(renderer, instant);
    instant.lamps = {tail_lamp(ahead_m)};
    const RadianceImage dry = drawn(renderer, instant);
    instant.environment.road_wetness = 1.0;
    const RadianceImage wet = drawn(renderer, instant);
    // Eye and lamp stand 1.9 m over the road together.
    const double grazing = 1.9 / ahead_m, water = 0.02 + 0.98 * std::pow(1.0 - grazing, 5.0);
    // Light of the lens, which is not drawn here, in addition to the glow.
    const double lens = double(0.55f * instant.emission_share) * 3.14159 * 0.09 * 0.09 / (taller * pixel_m * pixel_m);
    const double share = more(wet, dry).r / (more(dry, dark).r + lens);
    // Second moments of the streak, about its middle.
    double sum = 0.0, middle = 0.0, height = 0.0, width = 0.0, brightest = 0.0, peak = 0.0;
    for (std::uint32_t y = 0; y < side_px; ++y)
      for (std::uint32_t x = 0; x < side_px; ++x) {
        const double light = double(wet.at(x, y).r) - double(dry.at(x, y).r);
        sum += light, middle += light * (y + 0.5);
        if (light > brightest) brightest = light, peak = y + 0.5;
      }
    middle /= sum;
    for (std::uint32_t y = 0; y < side_px; ++y)
      for (std::uint32_t x = 0; x < side_px; ++x) {
        const double light = double(wet.at(x, y).r) - double(dry.at(x, y).r);
        height += light * (y + 0.5 - middle) * (y + 0.5 - middle);
        width += light * (x + 0.5 - 0.5 * side_px) * (x + 0.5 - 0.5 * side_px);
      }
    const double ratio = taller * std::sqrt(height / width),
                 below = taller * (peak - 0.5 * side_px) * pixel_m / ahead_m;
    CAPTURE(share / water);
    CAPTURE(ratio);
    CHECK(share == relative(water, 0.25));
    // At so low an angle the streak is 1 / sin(grazing) times as high as wide: 11 at 20 m, 26 at 50 m.
    CHECK(ratio * grazing > 0.76);
    CHECK(ratio * grazing < 1.3);
    CHECK(below == relative(grazing, 0.1));
  }
}

}  // namespace septet::render
