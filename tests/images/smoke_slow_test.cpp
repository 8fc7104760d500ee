/// Smoke as it is drawn against smoke as it is computed: the attenuation of a bright wall behind it, read back in linear
/// radiance from both renderers.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include <doctest/doctest.h>
#include <glm/gtc/quaternion.hpp>

#include "engine/core/random.hpp"
#include "engine/instant/scene_summary.hpp"
#include "engine/light/puff.hpp"
#include "engine/render/renderer.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/ray_through.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/raytrace/whole_picture.hpp"
#include "tests/relative.hpp"

namespace septet {
namespace {

using instant::SmokePuff;
constexpr std::uint32_t smoke_width_px = 96, smoke_height_px = 64;

/// A wall far behind the smoke, brighter than anything that lights it.
scene::ResolvedScene bright_wall() {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.0f);
  material.emission = glm::vec3(2000.0f);
  return instant::lone_mesh(material, instant::wide_wall(), {Vec3(100, 0, 0), {1, 0, 0, 0}});
}

/// Straight ahead, 1.05 rad wide or, to have all of what is near, 2.3.
instant::FrameInput forward(bool wide = false) {
  instant::FrameInput input;
  input.environment = instant::reference_day();
  input.views = {instant::forward_view({0, 0, 0}, smoke_width_px, smoke_height_px)};
  if (wide) input.views[0].projection = instant::symmetric_view(input.views[0].projection.eye_m, 0.0, 0.0, 2.3, 2.3);
  return input;
}

/// Radiance of each pixel, by one renderer.
using Picture = std::vector<glm::vec3>;

Picture rastered(const scene::ResolvedScene& scene, const instant::Instant& instant) {
  auto renderer = *render::Renderer::create(
      {smoke_width_px, smoke_height_px, render::DevicePreference::software, true, render::Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(scene).has_value());
  REQUIRE(renderer.draw(instant).has_value());
  CHECK(renderer.statistics().validation_messages == 0);
  return renderer.read_radiance()->radiance;
}

Picture traced(const scene::ResolvedScene& scene, const instant::Instant& instant) {
  auto tracer = *raytrace::RayTracer::create(scene);
  tracer.begin(instant, {.samples = 256, .filter = raytrace::Filter::box});
  Picture picture;
  for (const raytrace::TracedPixel& pixel : raytrace::whole_picture(tracer, smoke_width_px, smoke_height_px).pixels)
    picture.push_back(pixel.radiance);
  return picture;
}

/// ∫ −ln T dΩ over the picture, from pixels and by the law of puff.hpp for the puffs as they are.
struct Attenuation {
  double drawn_sr = 0.0, computed_sr = 0.0;
};

/// Mean radiance of smoke by night, before nothing, in a headlight's beam or not.
double in_beam(bool raster, float intensity) {
  scene::ResolvedScene scene = bright_wall();
  scene.materials.front().emission = glm::vec3(0.0f);
  instant::FrameInput input = forward();
  input.environment.sun_elevation_rad = -0.4;
  Random random(5);
  const Vec3 eye_m = instant::world_eye(input.views.front());
  for (std::uint32_t i = 0; i < 300; ++i) {
    SmokePuff puff;
    puff.position_m = eye_m + Vec3(random.uniform(12.0, 20.0), random.uniform(-3.0, 3.0), random.uniform(-2.0, 0.5));
    puff.radius_m = 0.7f;
    puff.albedo = glm::vec3(0.5f);
    puff.extinction_area_m2 = 0.08f;
    puff.seed = i;
    input.smoke.push_back(puff);
  }
  instant::Instant instant = instant::describe(input, instant::summarise(scene));
  instant.headlights.clear();
  if (intensity > 0.0f) instant.headlights = {{eye_m + Vec3(2.0, 0.0, -0.5), {1.0f, 0.0f, 0.0f}, intensity, 1.0f}};
  const Picture picture = raster ? rastered(scene, instant) : traced(scene, instant);
  double sum = 0.0;
  for (const glm::vec3& radiance : picture) sum += radiance.g;
  return sum / static_cast<double>(picture.size());
}

template <typename Draw>
Attenuation attenuation(const std::vector<SmokePuff>& puffs, const Draw& draw, bool wide = false) {
  const scene::ResolvedScene scene = bright_wall();
  instant::FrameInput input = forward(wide);
  const Picture clear = draw(scene, instant::describe(input, instant::summarise(scene)));
  input.smoke = puffs;
  const Picture smoky = draw(scene, instant::describe(input, instant::summarise(scene)));
  const instant::FrameView& view = input.views.front();
  const Vec3 eye_m = instant::world_eye(view);
  Attenuation sum;
  for (std::uint32_t y = 0; y < smoke_height_px; ++y)
    for (std::uint32_t x = 0; x < smoke_width_px; ++x) {
      const Vec3 ray = instant::ray_through(view, x + 0.5, y + 0.5);
      const double solid_angle_sr = ray.x * ray.x * ray.x;  // Times that of a pixel straight ahead.
      const std::size_t at = std::size_t{y} * smoke_width_px + x;
      sum.drawn_sr -= solid_angle_sr * std::log(double(smoky[at].g) / double(clear[at].g));
      for (const SmokePuff& puff : puffs) {
        const Vec3 way = puff.position_m - eye_m;
        const double along_m = glm::dot(way, ray), passes2 = glm::dot(way, way) - along_m * along_m;
        if (along_m > 0.0)
          sum.computed_sr += solid_angle_sr * puff.extinction_area_m2 /
                             (2.0 * 3.14159265 * puff.radius_m * puff.radius_m) *
                             std::exp(-0.5 * passes2 / (puff.radius_m * puff.radius_m));
      }
    }
  return sum;
}

SmokePuff black_puff(const Vec3& from_eye_m, float deviation_m, float depth, std::uint32_t seed) {
  SmokePuff puff;
  puff.position_m = from_eye_m + instant::world_eye(forward().views.front());
  puff.radius_m = deviation_m;
  puff.albedo = glm::vec3(0.0f);
  puff.extinction_area_m2 = depth * 2.0f * light::pi * deviation_m * deviation_m;
  puff.seed = seed;
  return puff;
}

/// Light of the ground before the eye without smoke and with it, high between the ground and the sun.
struct Shade {
  double without = 0.0, with = 0.0;  ///< Sums of the pixels' radiance.
  double least_share = 1.0;          ///< Of a pixel's radiance without smoke.
};

enum class Sky : std::uint8_t { black, blue };

void darken_sky(instant::Instant& instant) {
  instant::SkyLight light = *instant.light;
  light.sky_irradiance = light.ground_irradiance = glm::vec3(0.0f);
  light.irradiance = light.street_irradiance = {};
  light.table.radiance.assign(light.table.radiance.size(), glm::vec3(0.0f));
  instant.light = std::make_shared<const instant::SkyLight>(light);
}

template <typename Draw>
Shade shade_on_ground(Sky sky, float albedo, float depth, const Draw& draw) {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.5f);
  material.roughness = 1.0f;
  // A wall that lies on its back.
  const scene::ResolvedScene scene =
      instant::lone_mesh(material, instant::wide_wall(), {Vec3(0.0), glm::angleAxis(0.5 * 3.14159265, Vec3(0, 1, 0))});
  instant::FrameInput input = forward();
  input.environment.cloud_cover = 0.0;
  input.environment.sun_elevation_rad = 0.7;
  instant::Instant instant = instant::describe(input, instant::summarise(scene));
  instant.extinction_per_m = 0.0f;
  if (sky == Sky::black) darken_sky(instant);
  const Picture clear = draw(scene, instant);
  Random random(9);
  const Vec3 middle_m = Vec3(8.0, 0.0, 0.0) + 15.0 * Vec3(instant.light->light_direction);
  for (std::uint32_t i = 0; i < 300; ++i) {
    SmokePuff puff = black_puff(Vec3(0.0), 0.8f, depth, i);
    puff.position_m = middle_m + 2.0 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    puff.albedo = glm::vec3(albedo);
    instant.smoke.push_back(puff);
  }
  const Picture smoky = draw(scene, instant);
  Shade shade;
  for (std::size_t n = smoke_width_px * (smoke_height_px / 2 + 6); n < clear.size(); ++n) {
    shade.without += double(clear[n].g), shade.with += double(smoky[n].g);
    shade.least_share = std::min(shade.least_share, double(smoky[n].g) / double(clear[n].g));
  }
  return shade;
}

/// Radiance of thick smoke by day, at its middle, from the front.
template <typename Draw>
double thick_smoke(double sun_azimuth_rad, float albedo, const Draw& draw) {
  // Nothing but smoke and sky is in view.
  const scene::ResolvedScene scene = instant::lone_mesh({}, instant::wide_wall(), {Vec3(0.0, 0.0, -9e4)});
  instant::FrameInput input = forward();
  input.environment.cloud_cover = 0.0;
  input.environment.sun_elevation_rad = 0.7;
  input.environment.sun_azimuth_rad = sun_azimuth_rad;
  Random random(9);
  for (std::uint32_t i = 0; i < 600; ++i) {
    SmokePuff puff = black_puff(
        Vec3(18.0, 0.0, 0.0) + 4.0 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)), 0.8f,
        0.2f, i);
    puff.albedo = glm::vec3(albedo);
    input.smoke.push_back(puff);
  }
  instant::Instant instant = instant::describe(input, instant::summarise(scene));
  instant.extinction_per_m = 0.0f;
  const Picture picture = draw(scene, instant);
  double sum = 0.0;
  for (std::uint32_t y = 26; y < 38; ++y)
    for (std::uint32_t x = 42; x < 54; ++x) sum += double(picture[std::size_t{y} * smoke_width_px + x].g) / 144.0;
  return sum;
}

}  // namespace

TEST_CASE("of one puff both renderers draw what is computed from far away to 1.2 radii before the eye") {
  for (const double away_m : {12.0, 6.0, 1.2 * double(light::puff_reach)})
    for (const std::uint32_t seed : {1u, 77u, 500u}) {
      const std::vector puffs{black_puff({away_m, 0.0, 0.0}, 1.0f, 0.4f, seed)};
      const Attenuation raster = attenuation(puffs, rastered, away_m < 5.0);
      CAPTURE(away_m);
      CAPTURE(seed);
      CHECK(raster.drawn_sr == relative(raster.computed_sr, 0.03));
      if (seed != 1u) continue;  // The ray tracer knows no pattern.
      const Attenuation trace = attenuation(puffs, traced, away_m < 5.0);
      CHECK(trace.drawn_sr == relative(trace.computed_sr, 0.03));
    }
}

TEST_CASE("of a cloud that is merged both renderers draw what is computed and so the same") {
  Random random(3);
  std::vector<SmokePuff> puffs;
  for (std::uint32_t i = 0; i < 400; ++i)
    puffs.push_back(black_puff({30.0 + random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0), random.uniform(-3.0, 3.0)},
                               0.7f, 0.02f, i));
  const Attenuation raster = attenuation(puffs, rastered), trace = attenuation(puffs, traced);
  CHECK(raster.drawn_sr == relative(raster.computed_sr, 0.03));
  CHECK(trace.drawn_sr == relative(trace.computed_sr, 0.03));
  CHECK(raster.drawn_sr == relative(trace.drawn_sr, 0.03));
}

TEST_CASE("smoke in the beam of a headlight shines by as much in the rasteriser as in the ray tracer") {
  const double raster = in_beam(true, 100.0f) - in_beam(true, 0.0f),
               trace = in_beam(false, 100.0f) - in_beam(false, 0.0f);
  CHECK(raster > 0.0);
  CHECK(raster == relative(trace, 0.15));
}

TEST_CASE("the ground below smoke loses as much of the sun in the rasteriser as in the ray tracer") {
  for (const Sky sky : {Sky::black, Sky::blue})
    for (const float depth : {0.01f, 0.05f}) {
      const Shade raster = shade_on_ground(sky, 0.25f, depth, rastered),
                  trace = shade_on_ground(sky, 0.25f, depth, traced);
      CAPTURE(depth);
      CHECK(trace.with < 0.85 * trace.without);
      // The rasteriser has no shade of smoke in the light of the sky.
      const double of_loss = sky == Sky::black ? 0.02 : 0.05;
      CHECK(1.0 - raster.with / raster.without == relative(1.0 - trace.with / trace.without, of_loss));
      CHECK(std::abs(raster.least_share - trace.least_share) < (sky == Sky::black ? 0.02 : 0.06));
    }
}

TEST_CASE("thick smoke by day is as bright in the rasteriser as in the ray tracer within a quarter, from three sides") {
  for (const double azimuth_rad : {0.0, 1.57, 3.14})
    for (const float albedo : {0.25f, 0.8f}) {
      const double raster = thick_smoke(azimuth_rad, albedo, rastered),
                   trace = thick_smoke(azimuth_rad, albedo, traced);
      CAPTURE(azimuth_rad);
      CAPTURE(albedo);
      CHECK(raster == relative(trace, 0.27));
    }
}

}  // namespace septet
