/// Widths of shadows' edges, measured in pictures. Software device, validation layer on.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/image/png.hpp"
#include "engine/render/renderer.hpp"
#include "tests/checkout.hpp"
#include "tests/engine/instant/lone_mesh.hpp"
#include "tests/engine/instant/reference_scene.hpp"
#include "tests/relative.hpp"

namespace septet::render {
namespace {

constexpr std::uint32_t edge_width_px = 320, edge_height_px = 16;

/// Level ground, and a plate at a height above it whose shadow, the sun in the east and half way up, ends on the x
/// axis.
scene::ResolvedScene plate_over_ground(float height_m) {
  scene::SurfaceMesh mesh;
  const auto add_level = [&](float x0, float x1, float y0, float y1, float z) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& [x, y] : {std::pair(x0, y0), std::pair(x1, y0), std::pair(x1, y1), std::pair(x0, y1)})
      mesh.vertices.push_back({{x, y, z}, {0.0f, 0.0f, 1.0f}, {}});
    mesh.indices.insert(mesh.indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
  };
  add_level(-60.0f, 60.0f, -60.0f, 60.0f, 0.0f);
  add_level(height_m - 6.0f, height_m + 6.0f, 0.0f, 14.0f, height_m);
  scene::SurfaceMaterial material;
  material.base_color = glm::vec3(0.4f);
  return lone_mesh(material, mesh, {Vec3(0.0), {1, 0, 0, 0}});
}

struct Edge {
  double width_m;  ///< From a tenth of the light to nine tenths.
  double lit, dark;
};

Edge edge_of_shadow(ShadowEdges edges, float height_m) {
  Renderer renderer = *Renderer::create({.width = edge_width_px,
                                         .height = edge_height_px,
                                         .device = DevicePreference::software,
                                         .validation = true,
                                         .antialiasing = Antialiasing::none,
                                         .shadow_edges = edges});
  REQUIRE(renderer.upload(plate_over_ground(height_m)).has_value());
  FrameInput input;
  input.environment = reference_day();
  input.environment.sun_elevation_rad = 0.25 * std::numbers::pi;
  input.environment.sun_azimuth_rad = 0.5 * std::numbers::pi;
  input.environment.cloud_cover = 0.0;
  input.views = {forward_view({0, 0, 0}, edge_width_px, edge_height_px)};
  // View straight down from below the plate: a row of pixels lies across the edge, 2.1 m of it.
  constexpr double eye_m = 2.5, half_angle_rad = 0.4;
  input.views[0].projection =
      symmetric_view({0, 0, eye_m}, 0.0, -0.4999 * std::numbers::pi, 2.0 * half_angle_rad, 0.04);
  REQUIRE(renderer.draw(input).has_value());
  CHECK_MESSAGE(renderer.statistics().validation_messages == 0, renderer.statistics().first_validation_message);
  const std::string name = std::string(edges == ShadowEdges::soft ? "soft" : "narrow") + "_shadow_" +
                           std::to_string(static_cast<int>(height_m)) + "_m.png";
  image::write_png(build_folder() + "/images/" + name, *renderer.read_back());
  const RadianceImage light = *renderer.read_radiance();
  const auto at = [&](std::uint32_t column) { return double{light.at(column, edge_height_px / 2).g}; };
  const Edge ends{0.0, std::max(at(0), at(edge_width_px - 1)), std::min(at(0), at(edge_width_px - 1))};
  std::uint32_t between_px = 0;
  for (std::uint32_t column = 0; column < edge_width_px; ++column) {
    const double share = (at(column) - ends.dark) / (ends.lit - ends.dark);
    between_px += share > 0.1 && share < 0.9;
  }
  return {between_px * 2.0 * eye_m * std::tan(half_angle_rad) / edge_width_px, ends.lit, ends.dark};
}

}  // namespace

TEST_CASE("a soft shadow's edge is as wide as the sun's disc makes it, and light and shade are those of a narrow one") {
  for (const float height_m : {3.0f, 40.0f}) {
    CAPTURE(height_m);
    const Edge narrow = edge_of_shadow(ShadowEdges::narrow, height_m),
               soft = edge_of_shadow(ShadowEdges::soft, height_m);
    CAPTURE(narrow.width_m);
    CAPTURE(soft.width_m);
    // 80 % of a disc's penumbra lie within 1.37 of its radii.
    const double way_m = height_m * std::numbers::sqrt2, suns_m = 1.37 * 0.00465 * way_m;
    constexpr double texel_m = 0.043;
    CHECK(narrow.width_m < 2.0 * texel_m);
    CHECK(soft.width_m < suns_m + 2.5 * texel_m);
    CHECK(soft.width_m > 0.8 * suns_m);
    CHECK(soft.lit == relative(narrow.lit, 0.01));
    CHECK(soft.dark == relative(narrow.dark, 0.01));
  }
}

}  // namespace septet::render
