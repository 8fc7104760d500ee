#include "engine/raytrace/denoise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <utility>

#include <doctest/doctest.h>

#include "engine/raytrace/displayed.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

const instant::Exposure exposure = instant::exposure_of_scale(1.0f);

double rmse(const TracedPicture& a, const TracedPicture& b) {
  double squares = 0.0;
  // Below the lamp only, whose edge outweighs all else.
  for (std::size_t n = a.pixels.size() / 4; n < a.pixels.size(); ++n) {
    const glm::dvec3 off = glm::dvec3(a.pixels[n].radiance) - glm::dvec3(b.pixels[n].radiance);
    squares += glm::dot(off, off);
  }
  return std::sqrt(squares / (2.25 * static_cast<double>(a.pixels.size())));
}

}  // namespace

TEST_CASE("without its noise a picture is nearer to one of many samples and its mean stays") {
  const instant::Instant instant = before_cornell_box(40);
  const TracedPicture noisy = traced(cornell_box(), instant, cornell_settings(16, 1)),
                      reference = traced(cornell_box(), instant, cornell_settings(200, 2)),
                      clean = denoised(noisy, exposure);
  const double before = rmse(noisy, reference), after = rmse(clean, reference);
  MESSAGE("RMSE ", before, " with noise, ", after, " without");
  CHECK(after < 0.6 * before);
  CHECK(mean_of(clean).radiance.x == relative(mean_of(noisy).radiance.x, 0.03));
}

TEST_CASE("a picture without noise stays as it is within a code of a display") {
  const instant::Instant instant = before_cornell_box(32);
  TracedPicture sharp = traced(cornell_box(), instant, cornell_settings(32));
  for (TracedPixel& pixel : sharp.pixels) pixel.variance = 0.0f;
  const image::Image before = displayed(sharp, exposure), after = displayed(denoised(sharp, exposure), exposure);
  int largest = 0;
  for (std::size_t n = 0; n < before.rgba.size(); ++n)
    largest = std::max(largest, std::abs(before.rgba[n] - after.rgba[n]));
  CHECK(largest <= 1);
}

TEST_CASE("an edge that is painted on a surface or between two of them stays sharp") {
  // Two halves, noise on both: of one light but other albedo, then of one albedo but other normals and light.
  for (const bool painted : {true, false}) {
    CAPTURE(painted);
    TracedPicture picture(48, 32);
    double left = 0.0, right = 0.0;
    for (std::uint32_t n = 0; n < picture.pixels.size(); ++n) {
      PathRandom random(1, n, 0, 0);
      const bool is_left = n % 48 < 24;
      TracedPixel& pixel = picture.pixels[n];
      pixel.object = 1;
      pixel.albedo = glm::vec3(painted && is_left ? 0.8f : 0.2f);
      pixel.normal = painted || is_left ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
      const float light = painted || is_left ? 1.0f : 0.8f;
      pixel.radiance = pixel.albedo * light * (1.0f + 0.5f * (random.uniform() - 0.5f));
      pixel.variance = pixel.albedo.x * pixel.albedo.x * light * light * 0.25f / 12.0f;
    }
    const TracedPicture clean = denoised(picture, exposure);
    for (std::uint32_t y = 8; y < 24; ++y)
      left += clean.at(23, y).radiance.x / 16.0, right += clean.at(24, y).radiance.x / 16.0;
    CHECK(left == relative(painted ? 0.8 : 0.2, 0.06));
    CHECK(right == relative(painted ? 0.2 : 0.16, 0.06));
    CHECK(std::abs(clean.at(23, 16).radiance.x - left) < 0.15 * left);
  }
}

TEST_CASE("a spark that few samples met makes no patch and what is smooth keeps its light") {
  const glm::vec3 smooth(0.2f);
  TracedPicture picture(48, 48);
  for (std::uint32_t n = 0; n < picture.pixels.size(); ++n) {
    PathRandom random(2, n, 0, 0);
    TracedPixel& pixel = picture.pixels[n];
    pixel.object = 1, pixel.albedo = glm::vec3(0.2f), pixel.normal = glm::vec3(0, 0, 1);
    pixel.radiance = smooth * (1.0f + 0.4f * (random.uniform() - 0.5f));
    pixel.variance = 0.2f * 0.2f * 0.16f / 12.0f;
  }
  // One of 16 samples met light of 160: the mean is 10 and its deviation as much.
  for (const auto& [x, y] : {std::pair{12u, 12u}, {30u, 20u}, {20u, 36u}}) {
    TracedPixel& spark = picture.pixels[y * 48 + x];
    spark.radiance += glm::vec3(10.0f), spark.variance = 100.0f;
  }
  const TracedPicture clean = denoised(picture, exposure);
  double mean = 0.0;
  float brightest = 0.0f;
  for (const TracedPixel& pixel : clean.pixels) {
    mean += pixel.radiance.x / static_cast<double>(clean.pixels.size());
    brightest = std::max(brightest, pixel.radiance.x);
  }
  CHECK(mean == relative(0.2, 0.01));
  CHECK(brightest < 0.25f);
}

TEST_CASE("lamps that some samples met and others missed leave the dark around them dark") {
  TracedPicture picture(48, 48);
  for (std::uint32_t n = 0; n < picture.pixels.size(); ++n) {
    PathRandom random(3, n, 0, 0);
    TracedPixel& pixel = picture.pixels[n];
    pixel.object = 1, pixel.albedo = glm::vec3(0.2f), pixel.normal = glm::vec3(0, 0, 1);
    pixel.radiance = glm::vec3(0.01f * (1.0f + 0.4f * (random.uniform() - 0.5f)));
    pixel.variance = 1e-4f * 0.16f / 12.0f;
  }
  // Five lamps in a row, met by one sample in 16 to three of four.
  for (std::uint32_t n = 0; n < 5; ++n) {
    TracedPixel& lamp = picture.pixels[20 * 48 + 18 + 3 * n];
    const float share = 0.0625f + 0.17f * static_cast<float>(n);
    lamp.radiance += glm::vec3(1000.0f * share);
    lamp.variance = 1e6f * share * (1.0f - share) / 16.0f;
  }
  const TracedPicture clean = denoised(picture, exposure);
  float brightest = 0.0f;
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 48; ++x)
      if (y < 18 || y > 22) brightest = std::max(brightest, clean.at(x, y).radiance.x);
  CHECK(brightest < 0.02f);
  CHECK(clean.at(30, 20).radiance.x > 100.0f);
}

TEST_CASE("the noise goes the same way bit for bit each time and numbers stay numbers") {
  TracedPicture picture = traced(cornell_box(), before_cornell_box(33), cornell_settings(4));
  picture.pixels[40].radiance = glm::vec3(3e30f);
  picture.pixels[40].variance = std::numeric_limits<float>::infinity();
  picture.pixels[600] = TracedPixel{};
  const TracedPicture a = denoised(picture, exposure), b = denoised(picture, exposure);
  CHECK(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(TracedPixel)) == 0);
  bool numbers = true;
  for (const TracedPixel& pixel : a.pixels) numbers = numbers && std::isfinite(pixel.radiance.x);
  CHECK(numbers);
}

}  // namespace septet::raytrace
