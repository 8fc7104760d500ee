/// Distinguishability of things for the driver, measured on the motorway.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/render/renderer.hpp"
#include "tests/images/motorway_view.hpp"

namespace septet {
namespace {

/// CIE L* beside white.
double lightness(double luminance, double white) {
  const double y = std::max(luminance / white, 0.0);
  return y > 0.008856 ? 116.0 * std::cbrt(y) - 16.0 : 903.3 * y;
}

}  // namespace

TEST_CASE(
    "under clouds a car painted like asphalt is told from the road thirty metres ahead over most of what is seen") {
  const Motorway motorway;
  render::Renderer renderer =
      *render::Renderer::create({motorway_width_px, motorway_height_px, render::DevicePreference::software, false,
                                 render::Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(motorway.scene()).has_value());
  instant::FrameInput input = motorway.frame({"overcast", 800.0, 0.0, false, false});
  input.environment.cloud_cover = 1.0;
  input.participants.resize(1);
  input.participants[0].world_from_vehicle =
      motorway.frame({"its place", 830.0, 0.0, false, false}).views[0].world_from_car;
  input.participants[0].lamps = {};
  input.participants[0].paint = glm::vec3(0.12f);
  REQUIRE(renderer.draw(input).has_value());
  const render::RadianceImage with = *renderer.read_radiance();
  input.participants.clear();
  REQUIRE(renderer.draw(input).has_value());
  const render::RadianceImage without = *renderer.read_radiance();
  const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
  // White is that of a white board on the road.
  const instant::SkyLight light = instant::sky_light(input.environment);
  const double white = double(glm::dot(light.sky_irradiance, weights)) / 3.14159;
  int changed = 0, told = 0;
  for (std::size_t i = 0; i < with.radiance.size(); ++i) {
    if (glm::length(with.radiance[i] - without.radiance[i]) < 1e-5f) continue;
    const double apart = lightness(double(glm::dot(with.radiance[i], weights)), white) -
                         lightness(double(glm::dot(without.radiance[i], weights)), white);
    ++changed;
    told += std::abs(apart) > 5.0;
  }
  CAPTURE(changed);
  CAPTURE(told);
  CHECK(changed > 200);
  CHECK(told > changed / 2);
}

TEST_CASE("plates that stand beside each other in traffic are all different") {
  const Motorway motorway;
  int materials = 0;
  for (const scene::SurfaceMaterial& material : motorway.scene().materials) {
    const std::uint32_t columns = material.picture_columns, rows = material.picture_rows;
    if (columns * rows < 2 || material.base_color_image < 0) continue;
    ++materials;
    const scene::TextureImage& image = motorway.scene().images[static_cast<std::size_t>(material.base_color_image)];
    std::set<std::vector<std::uint8_t>> pictures;
    for (std::uint32_t n = 0; n < columns * rows; ++n) {
      const std::uint32_t width = image.width / columns, height = image.height / rows;
      std::vector<std::uint8_t> picture;
      for (std::uint32_t y = n / columns * height; y < (n / columns + 1) * height; ++y)
        for (std::uint32_t x = n % columns * width; x < (n % columns + 1) * width; ++x)
          picture.push_back(image.rgba[4 * (std::size_t{y} * image.width + x)]);
      pictures.insert(std::move(picture));
    }
    CHECK(pictures.size() == columns * rows);
    CHECK(pictures.size() >= 32);
  }
  CHECK(materials > 0);
}

}  // namespace septet
