/// Light around bright pixels. Software device, validation layer on.

#include <cstdint>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/engine/render/glowing_bar.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t bloom_width = 256, bloom_height = 192;

/// A lit square of 0.5 m, 4 m ahead, at night: about 30 pixels wide.
RadianceImage lit_square(Bloom bloom, Antialiasing antialiasing) {
  Renderer renderer = *Renderer::create(
      {bloom_width, bloom_height, DevicePreference::software, true, antialiasing, nullptr, false, bloom});
  scene::SurfaceMesh square;
  for (const auto& [y, z] : {std::pair{0.25f, -0.25f}, {-0.25f, -0.25f}, {-0.25f, 0.25f}, {0.25f, 0.25f}})
    square.vertices.push_back({{0.0f, y, z}, {-1, 0, 0}, {}});
  square.indices = {0, 1, 2, 0, 2, 3};
  FrameInput input;
  input.environment = reference_day();
  input.environment.sun_elevation_rad = -0.5;
  input.environment.cloud_cover = 1.0;
  input.views = {forward_view({0, 0, 0}, bloom_width, bloom_height)};
  REQUIRE(
      renderer.upload(lone_mesh(glowing_material(), square, {world_eye(input.views[0]) + Vec3(4, 0, 0), {1, 0, 0, 0}}))
          .has_value());
  // Twice: the second frame finds the first one's remains.
  REQUIRE(renderer.draw(input).has_value());
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  if (bloom == Bloom::present) image::write_png(build_folder() + "/images/bloom.png", *renderer.read_back());
  return *renderer.read_radiance();
}

double sum_of_green(const RadianceImage& image) {
  double sum = 0.0;
  for (const glm::vec3& light : image.radiance) sum += light.g;
  return sum;
}

}  // namespace

TEST_CASE(
    "bloom carries a few hundredths of a lamp's light around it, less with distance, and neither gains nor loses any") {
  for (const Antialiasing antialiasing : {Antialiasing::none, Antialiasing::multisampled}) {
    const RadianceImage without = lit_square(Bloom::none, antialiasing),
                        with = lit_square(Bloom::present, antialiasing);
    CHECK(sum_of_green(with) == relative(sum_of_green(without), 0.01));
    const auto gained = [&](std::uint32_t beside_px) {
      const std::uint32_t x = bloom_width / 2 + 15 + beside_px, y = bloom_height / 2;
      return with.at(x, y).g - without.at(x, y).g;
    };
    const float lamp = without.at(bloom_width / 2, bloom_height / 2).g;
    CHECK(lamp > 10.0f * without.at(bloom_width / 2 + 40, bloom_height / 2).g);
    CHECK(gained(5) > 1e-3f * lamp);
    CHECK(gained(5) < 3e-2f * lamp);
    CHECK(gained(15) < gained(5));
    CHECK(gained(40) < gained(15));
    CHECK(gained(40) > 0.0f);
  }
}

TEST_CASE("a device of software draws without bloom unless it is asked to") {
  const RadianceImage automatic = lit_square(Bloom::automatic, Antialiasing::none),
                      none = lit_square(Bloom::none, Antialiasing::none);
  CHECK(automatic.radiance == none.radiance);
}

}  // namespace septet::render
