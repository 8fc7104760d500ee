#include "engine/raytrace/ray_tracer.hpp"

#include <cstring>

#include <doctest/doctest.h>

#include "tests/engine/raytrace/traced_scenes.hpp"

namespace septet::raytrace {
namespace {

bool same_bits(const TracedPicture& a, const TracedPicture& b) {
  return a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(TracedPixel)) == 0;
}

}  // namespace

TEST_CASE("a picture is the same bit for bit in any order of any buckets on any number of threads") {
  const scene::ResolvedScene box = cornell_box();
  auto tracer = RayTracer::create(box);
  REQUIRE(tracer.has_value());
  TraceSettings settings = cornell_settings(2);
  settings.filter = Filter::cubic;
  tracer->begin(before_cornell_box(40), settings);
  const TracedPicture whole = whole_picture(*tracer, 40, 40);
  for (const std::uint32_t side_px : {7u, 33u, 40u}) {
    TracedPicture other(40, 40);
    auto buckets = buckets_of(40, 40, side_px);
    std::reverse(buckets.begin(), buckets.end());
    for (const auto& rectangle : buckets) other.put(tracer->trace(rectangle));
    CHECK(same_bits(whole, other));
  }
  // Another machine builds its own hierarchies.
  CHECK(same_bits(whole, traced(box, before_cornell_box(40), settings)));
  settings.seed = 1;
  CHECK_FALSE(same_bits(whole, traced(box, before_cornell_box(40), settings)));
}

TEST_CASE("light that is not a number is counted and black") {
  scene::SurfaceMaterial material;
  material.emission = glm::vec3(std::numeric_limits<float>::quiet_NaN());
  const TracedPicture picture =
      traced(ball_scene(material, 1), instant_from({-4.0, 0.0, 0.0}, 0.7, 16, even_sky(0.25f)), {.samples = 4});
  CHECK(picture.bad_samples > 0);
  for (const TracedPixel& pixel : picture.pixels) CHECK(std::isfinite(pixel.radiance.x));
}

TEST_CASE("what the sun gives and what the sky gives add up whichever is looked at") {
  // Which kind of light is looked at is a matter of chance; what is found is not.
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(0.5f);
  white.roughness = 1.0f;
  scene::ResolvedScene scene = ball_scene(white, 3);
  const auto mean = [&](float sky, std::uint32_t seed) {
    auto light = *even_sky(sky);
    light.light_direction = glm::normalize(glm::vec3(-1.0f, 0.2f, 0.5f));
    light.light_irradiance = glm::vec3(2.0f);
    instant::Instant instant =
        instant_from({-4.0, 0.0, 0.0}, 0.3, 24, std::make_shared<const instant::SkyLight>(light));
    return mean_of(traced(scene, instant, {.samples = 64, .filter = Filter::box, .seed = seed}));
  };
  const PictureMean dark = mean(0.0f, 0), dim = mean(0.1f, 1);
  // The whole view is filled by the ball, which gives back half of the sky wherever it is convex.
  CHECK(std::abs(dim.radiance.x - dark.radiance.x - 0.05) < 4.0 * std::hypot(dark.sigma, dim.sigma) + 1e-4);
}

}  // namespace septet::raytrace
