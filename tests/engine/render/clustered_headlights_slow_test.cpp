/// Light of headlights for each method of lighting, measured in pictures. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/instant/adaptation.hpp"
#include "engine/instant/headlight_beam.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t lit_side_px = 160;

scene::ResolvedScene bare_ground() {
  scene::SurfaceMesh mesh;
  for (const auto& [x, y] :
       {std::pair(-1.0f, -1.0f), std::pair(1.0f, -1.0f), std::pair(1.0f, 1.0f), std::pair(-1.0f, 1.0f)})
    mesh.vertices.push_back({{300.0f * x, 300.0f * y, 0.0f}, {0.0f, 0.0f, 1.0f}, {}});
  mesh.indices = {0, 1, 2, 0, 2, 3};
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.4f);
  return lone_mesh(material, mesh, {Vec3(0.0), {1, 0, 0, 0}});
}

/// This many cars side by side, ten metres apart, their beams along x, seen at night from 60 m above the middle of the
/// lit area.
RadianceImage light_of(Headlights headlights, int cars) {
  Renderer renderer = *Renderer::create({.width = lit_side_px,
                                         .height = lit_side_px,
                                         .device = DevicePreference::software,
                                         .validation = true,
                                         .antialiasing = Antialiasing::none,
                                         .headlights = headlights});
  REQUIRE(renderer.upload(bare_ground()).has_value());
  FrameInput input;
  input.environment = reference_day();
  input.environment.sun_elevation_rad = -0.4;
  input.environment.sun_illuminance_lux = 0.0;
  input.views = {forward_view({0, 0, 0}, lit_side_px, lit_side_px)};
  input.views[0].projection = symmetric_view({0, 0, 60.0}, 0.0, -1.57, 2.0, 2.0);
  Instant instant = describe(std::move(input), {}, std::make_shared<const SkyLight>(sky_light([] {
                               Environment night = reference_day();
                               night.sun_elevation_rad = -0.4;
                               night.sun_illuminance_lux = 0.0;
                               return night;
                             }())));
  // Nights are displayed this much brighter than real (instant.cpp: seen_headlights).
  const float bright = instant::beam::pair_intensity * instant::most_light_up;
  for (int i = 0; i < cars; ++i)
    instant.headlights.push_back({Vec3(-30.0, 10.0 * (i - 0.5 * (cars - 1)), 0.65), {1, 0, 0}, bright});
  REQUIRE(renderer.draw(instant).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  const std::string name = std::string(headlights == Headlights::clustered ? "clustered" : "nearest") + "_headlights_" +
                           std::to_string(cars) + ".png";
  image::write_png(build_folder() + "/images/" + name, *renderer.read_back());
  return *renderer.read_radiance();
}

double brightest(const RadianceImage& image) {
  double most = 0.0;
  for (const glm::vec3& radiance : image.radiance) most = std::max(most, double{radiance.g});
  return most;
}

double greatest_difference(const RadianceImage& a, const RadianceImage& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.radiance.size(); ++i)
    most = std::max(most, std::abs(double{a.radiance[i].g} - double{b.radiance[i].g}));
  return most;
}

}  // namespace

TEST_CASE("eight pairs of headlights light the same ground alike whether they are clustered or not") {
  const RadianceImage nearest = light_of(Headlights::nearest, 8), clustered = light_of(Headlights::clustered, 8);
  const double thrown = greatest_difference(nearest, light_of(Headlights::nearest, 0));
  CHECK(thrown > 0.3 * brightest(nearest));
  CHECK(greatest_difference(nearest, clustered) < 0.005 * thrown);
}

TEST_CASE(
    "of twelve pairs clustered headlights light the outermost lanes as the middle ones, which the nearest eight leave "
    "dark") {
  const RadianceImage nearest = light_of(Headlights::nearest, 12), clustered = light_of(Headlights::clustered, 12);
  const RadianceImage dark = light_of(Headlights::nearest, 0);
  // Row by row downwards x falls, from left to right y does: the beams' light 25 m ahead of their cars.
  const auto at = [&dark](const RadianceImage& image, double x_m, double y_m) {
    const auto pixel = [](double metres) {
      return static_cast<std::uint32_t>(std::lround(0.5 * lit_side_px * (1.0 - metres / (60.0 * std::tan(1.0)))));
    };
    return double{image.at(pixel(y_m), pixel(x_m)).g} - double{dark.at(pixel(y_m), pixel(x_m)).g};
  };
  const double outermost = at(clustered, -5.0, 55.0), middle = at(clustered, -5.0, 5.0);
  CHECK(outermost > 0.5 * middle);
  CHECK(at(nearest, -5.0, 55.0) < 0.4 * outermost);
  CHECK(at(nearest, -5.0, 5.0) == relative(middle, 0.1));
}

}  // namespace septet::render
