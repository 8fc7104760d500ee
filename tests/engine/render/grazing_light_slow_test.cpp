/// Shadows on surfaces grazed by the sun's light, measured in a picture. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <string>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t grazing_width = 320, grazing_height = 160;

/// A barrier of 60 m along x: a foot that leans back, a steeper wall on it, and a back without foot.
scene::ResolvedScene barrier() {
  constexpr glm::vec2 profile[] = {{0.0f, 0.0f}, {0.4f, 0.5f}, {0.45f, 1.0f}, {0.6f, 1.0f}, {0.6f, 0.0f}};  // y, z
  scene::SurfaceMesh mesh;
  for (std::size_t i = 0; i + 1 < std::size(profile); ++i) {
    const glm::vec2 along = glm::normalize(profile[i + 1] - profile[i]);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const float x : {-30.0f, 30.0f})
      for (const glm::vec2& at : {profile[i], profile[i + 1]})
        mesh.vertices.push_back({{x, at.x, at.y}, {0.0f, -along.y, along.x}, {}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 2, first + 3, first, first + 3, first + 1});
  }
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.4f);
  return lone_mesh(material, mesh, {Vec3(0.0), {1, 0, 0, 0}});
}

}  // namespace

TEST_CASE("where the sun grazes the foot of a straight barrier its shadow has an edge without teeth") {
  Renderer renderer =
      *Renderer::create({grazing_width, grazing_height, DevicePreference::software, true, Antialiasing::none, nullptr});
  REQUIRE(renderer.upload(barrier()).has_value());
  FrameInput input;
  input.environment = reference_day();
  input.environment.sun_elevation_rad = 0.785;
  input.environment.sun_azimuth_rad = 1.224;  // The foot's cosine is .25, and the wall's shadow ends on it.
  input.views = {forward_view({0, -2.5, 0}, grazing_width, grazing_height)};
  input.views[0].projection = symmetric_view({0, 0, 1.0}, 0.5 * std::numbers::pi, -0.3, 0.8, 0.4);
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  image::write_png(build_folder() + "/images/grazing_light.png", *renderer.read_back());
  const RadianceImage light = *renderer.read_radiance();
  // A row of pixels lies along the barrier: differences along it come from the shadow map. The wall ends at row 30, the
  // foot at 110.
  float brightest = 0.0f, darkest = 1e9f, largest_deviation = 0.0f;
  for (std::uint32_t row = 30; row < 110; ++row) {
    float mean = 0.0f, squares = 0.0f;
    for (std::uint32_t column = 0; column < grazing_width; ++column) mean += light.at(column, row).g / grazing_width;
    for (std::uint32_t column = 0; column < grazing_width; ++column) {
      const float from_mean = light.at(column, row).g - mean;
      squares += from_mean * from_mean / grazing_width;
    }
    brightest = std::max(brightest, mean);
    darkest = std::min(darkest, mean);
    largest_deviation = std::max(largest_deviation, std::sqrt(squares));
  }
  CHECK(brightest > 2.0f * darkest);
  CHECK(largest_deviation < 0.1f * (brightest - darkest));
}

}  // namespace septet::render
