#include "engine/raytrace/ray_tracer.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/light/fresnel.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
TEST_CASE("the Cornell box has the light that other renderers find in it") {
  const TracedPicture picture = traced(cornell_box(), before_cornell_box(128), cornell_settings(64));
  const PictureMean mean = mean_of(picture);
  const glm::dvec3 known(0.2339, 0.1402, 0.0599);
  MESSAGE("means ", mean.radiance.x, " ", mean.radiance.y, " ", mean.radiance.z, ", sigma ", mean.sigma);
  CHECK(picture.bad_samples == 0);
  // Sigma is that of the luminance; a channel's is about as large for its size. The known figures end with their fourth
  // digit.
  const double luminance_mean = glm::dot(known, glm::dvec3(0.2126, 0.7152, 0.0722));
  for (int c = 0; c < 3; ++c) {
    CAPTURE(c);
    CHECK(std::abs(mean.radiance[c] - known[c]) < 3.0 * mean.sigma * known[c] / luminance_mean + 5e-5);
  }
}

TEST_CASE("the Cornell box has by a final gather the light that paths find in it") {
  TraceSettings settings = cornell_settings(16);
  const PictureMean paths = mean_of(traced(cornell_box(), before_cornell_box(64), cornell_settings(64, 5)));
  settings.photons = {.global = 100000, .nearest = 50};
  settings.photons.global_reach_m = 0.1f;
  const TracedPicture picture = traced(cornell_box(), before_cornell_box(64), settings);
  const PictureMean gathered = mean_of(picture);
  MESSAGE("gathered ", gathered.radiance.x, " ", gathered.radiance.y, " ", gathered.radiance.z, ", by paths ",
          paths.radiance.x, " ", paths.radiance.y, " ", paths.radiance.z, "; sigma ", gathered.sigma, " and ",
          paths.sigma);
  for (int c = 0; c < 3; ++c) CHECK(gathered.radiance[c] / paths.radiance[c] == relative(1.0, 0.02));
}

TEST_CASE("the error falls with the root of the number of samples") {
  const auto error = [&](std::uint32_t samples) {
    const TracedPicture a = traced(cornell_box(), before_cornell_box(64), cornell_settings(samples, 1)),
                        b = traced(cornell_box(), before_cornell_box(64), cornell_settings(samples, 2));
    double squares = 0.0;
    // Below the lamp only: its few pixels at the edge would outweigh all others.
    for (std::size_t n = a.pixels.size() / 4; n < a.pixels.size(); ++n) {
      const glm::dvec3 off = glm::dvec3(a.pixels[n].radiance) - glm::dvec3(b.pixels[n].radiance);
      squares += glm::dot(off, off);
    }
    return std::sqrt(squares / static_cast<double>(a.pixels.size()));
  };
  const double few = error(8), many = error(128);
  MESSAGE("from 8 to 128 samples the error falls ", few / many, " times");
  CHECK(few / many == relative(4.0, 0.1));
}

TEST_CASE("a picture that is told its error has it and tells it") {
  instant::Instant instant = before_cornell_box(48);
  instant.exposure = instant::exposure_of_scale(1.0f);
  TraceSettings settings = cornell_settings(1 << 14, 1);
  settings.error = 0.06f;
  const TracedPicture a = traced(cornell_box(), instant, settings);
  settings.seed = 2;
  const TracedPicture b = traced(cornell_box(), instant, settings);
  // Reference with many more samples.
  const TracedPicture reference = traced(cornell_box(), instant, cornell_settings(1024, 3));
  double told = 0.0, found = 0.0, against_reference = 0.0, samples = 0.0, most = 0.0;
  for (std::size_t n = 0; n < a.pixels.size(); ++n) {
    const auto relative = [&](float off) { return off / std::max(luminance(reference.pixels[n].radiance), 0.1f); };
    const double error = relative_error(a.pixels[n], instant.exposure);
    const double off = relative(luminance(a.pixels[n].radiance - b.pixels[n].radiance));
    const double from_reference = relative(luminance(a.pixels[n].radiance - reference.pixels[n].radiance));
    told += error * error, found += 0.5 * off * off, against_reference += from_reference * from_reference;
    samples += a.pixels[n].samples, most = std::max<double>(most, a.pixels[n].samples);
  }
  const double pixels = static_cast<double>(a.pixels.size());
  told = std::sqrt(told / pixels), found = std::sqrt(found / pixels);
  against_reference = std::sqrt(against_reference / pixels);
  MESSAGE("wanted 0.06, told ", told, ", found ", found, ", against the reference ", against_reference, "; ",
          samples / pixels, " samples a pixel, at most ", most);
  CHECK(told <= 0.06);
  CHECK(found / told == relative(1.0, 0.15));
  CHECK(found < 0.066);
  CHECK(against_reference < 0.075);
  CHECK(most < 1 << 14);
  CHECK(std::abs(mean_of(a).radiance.x - mean_of(reference).radiance.x) <
        4.0 * std::hypot(mean_of(a).sigma, mean_of(reference).sigma));
}

TEST_CASE("a white ball under an even sky cannot be told from the sky") {
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(1.0f);
  white.roughness = 1.0f;
  const instant::Instant instant = instant_from({-4.0, 0.0, 0.0}, 0.7, 64, even_sky(2.0f));
  const TracedPicture picture = traced(ball_scene(white), instant, {.samples = 256});
  const glm::dvec3 mean = mean_of(picture).radiance;
  MESSAGE("the furnace is off by ", mean.x / 2.0 - 1.0);
  CHECK(std::abs(mean.x / 2.0 - 1.0) < 1e-3);
  // Under a reflecting layer light is only lost.
  white.roughness = 0.3f;
  const double layered = mean_of(traced(ball_scene(white), instant, {.samples = 64})).radiance.x;
  CHECK(layered < 2.001);
  CHECK(layered > 1.7);
}

TEST_CASE("within a ball that shines and reflects the light is the sum of a geometric series") {
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.5f);
  material.roughness = 1.0f;
  material.emission = glm::vec3(0.3f);
  scene::ResolvedScene scene = ball_scene(material, 2);
  scene::SurfaceMesh& mesh = scene.meshes[0];
  for (std::size_t n = 0; n < mesh.indices.size(); n += 3) std::swap(mesh.indices[n], mesh.indices[n + 1]);
  for (scene::SurfaceVertex& vertex : mesh.vertices) vertex.normal = -vertex.normal;
  for (const std::uint32_t longest : {1u, 2u, 5u}) {
    const instant::Instant instant = instant_from(Vec3(0.1, 0.0, 0.0), 1.2, 32, even_sky(0.0f));
    const double mean =
        mean_of(traced(scene, instant, {.samples = 256, .paths = {.longest = longest, .roulette_from = 2}})).radiance.x;
    const double series = 0.3 * (1.0 - std::pow(0.5, longest)) / 0.5;
    CAPTURE(longest);
    CHECK(std::abs(mean / series - 1.0) < 3e-3);
  }
}

TEST_CASE("through a ball of ice under an even sky goes what Fresnel and Beer and Lambert let through") {
  // Transmission along a chord: R + T² a (1 + R a + …), a = exp(−σ c), where each inner reflection meets the surface at
  // the same angle.
  const float index = 1.31f, absorption_per_m = 0.4f;
  ClearBody ice{.index = index, .absorption_per_m = glm::vec3(absorption_per_m)};
  const scene::SurfaceMesh shape = ball(6);
  for (const std::uint32_t n : shape.indices) ice.vertices.push_back(shape.vertices[n]);
  // Distance at which the rays of the picture are parallel.
  const double away_m = 2000.0, off_m = 1.2;
  const instant::Instant instant =
      instant_from({-away_m, 0.0, 0.0}, 2.0 * std::atan(off_m / away_m), 64, even_sky(1.0f));
  const TracedPicture picture = traced(
      {}, instant, {.samples = 64, .paths = {.longest = 64, .roulette_from = 100}, .filter = Filter::box}, {ice});
  double traced_sum = 0.0, known_sum = 0.0;
  for (std::uint32_t y = 0; y < 64; ++y)
    for (std::uint32_t x = 0; x < 64; ++x) {
      traced_sum += picture.at(x, y).radiance.x;
      constexpr int fine = 8;
      for (int k = 0; k < fine * fine; ++k) {
        const double across = ((x + (k % fine + 0.5) / fine) / 32.0 - 1.0) * off_m,
                     down = ((y + (k / fine + 0.5) / fine) / 32.0 - 1.0) * off_m;
        const double square = across * across + down * down;
        double light = 1.0;
        if (square < 1.0) {
          const double reflected =
              light::fresnel(static_cast<float>(std::sqrt(1.0 - square)), static_cast<float>(1.0 / index));
          const double clear = std::exp(-absorption_per_m * 2.0 * std::sqrt(1.0 - square / (index * index)));
          light = reflected + (1.0 - reflected) * (1.0 - reflected) * clear / (1.0 - reflected * clear);
        }
        known_sum += light / (fine * fine);
      }
    }
  MESSAGE("the ball of ice is off by ", traced_sum / known_sum - 1.0);
  CHECK(std::abs(traced_sum / known_sum - 1.0) < 2e-3);
  CHECK(picture.bad_samples == 0);
}

}  // namespace septet::raytrace
