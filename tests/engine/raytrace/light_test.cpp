// Light of lamps, sky and sun through the whole tracer, and its reflection by rough surfaces, against closed forms.
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <numbers>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "engine/raytrace/lamps.hpp"
#include "tests/engine/raytrace/traced_scenes.hpp"
#include "tests/relative.hpp"

namespace septet::raytrace {
namespace {

void add_part(scene::ResolvedScene& scene, const std::array<glm::vec3, 4>& corners,
              const scene::SurfaceMaterial& material) {
  if (scene.meshes.empty()) {
    scene.meshes.emplace_back();
    scene.meshes[0].bounds_min_m = glm::vec3(-100.0f), scene.meshes[0].bounds_max_m = glm::vec3(100.0f);
    scene.instances.push_back({});
  }
  scene::SurfaceMesh& mesh = scene.meshes[0];
  mesh.parts.push_back(
      {static_cast<std::uint32_t>(mesh.indices.size()), 6, static_cast<std::uint32_t>(scene.materials.size())});
  add_triangle(mesh, {corners[0], corners[1], corners[2]});
  add_triangle(mesh, {corners[0], corners[2], corners[3]});
  scene.materials.push_back(material);
}

/// Square at x, facing −x, from which side it is seen.
std::array<glm::vec3, 4> wall(float x, float half_m) {
  return {glm::vec3(x, -half_m, -half_m), {x, -half_m, half_m}, {x, half_m, half_m}, {x, half_m, -half_m}};
}

/// Needle view of one point of it, along a path in the plane of x and y.
instant::Instant needle(const Vec3& at_m, double aside_rad, std::shared_ptr<const instant::SkyLight> light) {
  const Vec3 eye_m = at_m - 4.0 * Vec3(std::cos(aside_rad), std::sin(aside_rad), 0.0);
  instant::Instant instant = instant_from(eye_m, 1e-4, 8, std::move(light));
  instant.views.front().projection = instant::symmetric_view(eye_m, aside_rad, 0.0, 1e-4, 1e-4);
  return instant;
}

TraceSettings direct(std::uint32_t samples) {
  return {.samples = samples, .paths = {.longest = 2}, .filter = Filter::box};
}

/// Form factor of a parallel rectangle with one corner straight ahead: its share of the hemisphere's cosines.
double of_corner(double a, double b) {
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * std::numbers::pi);
}

}  // namespace

TEST_CASE("a lamp lights a wall by the rectangle's form factor however rough the wall is") {
  scene::SurfaceMaterial white, lamp;
  white.base_color = glm::vec3(0.6f);
  white.roughness = 1.0f;
  lamp.base_color = glm::vec3(0.0f);
  lamp.emission = glm::vec3(7.0f);
  scene::ResolvedScene scene;
  add_part(scene, wall(5.0f, 3.0f), white);
  scene.instances.push_back({.mesh = 1});
  // Faces the wall at a distance of 1 m: beside the line of sight, and so far aside that light comes and goes at 80°.
  for (const float y0 : {0.2f, 5.5f}) {
    const float y1 = y0 + 1.3f, z0 = -0.5f, z1 = 0.8f;
    scene.meshes.resize(1);
    scene::SurfaceMesh tube;
    add_triangle(tube, {glm::vec3(4.0f, y0, z0), {4.0f, y1, z0}, {4.0f, y1, z1}});
    add_triangle(tube, {glm::vec3(4.0f, y0, z0), {4.0f, y1, z1}, {4.0f, y0, z1}});
    tube.parts.push_back({0, 6, 1});
    tube.bounds_min_m = {4.0f, y0, z0}, tube.bounds_max_m = {4.0f, y1, z1};
    scene.materials.resize(1);
    scene.materials.push_back(lamp);
    scene.meshes.push_back(std::move(tube));
    const auto corner = [](float y, float z) { return std::copysign(of_corner(y, std::abs(z)), z); };
    const double share = corner(y1, z1) - corner(y0, z1) - corner(y1, z0) + corner(y0, z0);
    const PictureMean mean = mean_of(traced(scene, needle({5.0, 0.0, 0.0}, 0.0, even_sky(0.0f)), direct(512)));
    CAPTURE(y0);
    CHECK(mean.sigma < 0.004 * 0.6 * 7.0 * share);
    CHECK(std::abs(mean.radiance.x - 0.6 * 7.0 * share) < 4.0 * mean.sigma);
  }
}

TEST_CASE("lamps are drawn with the chances that are told and only such as may light the surface") {
  std::vector<Lamp> lamps(21);
  for (std::size_t n = 0; n < lamps.size(); ++n) {
    const auto across = static_cast<float>(n);
    // Above the surface, partly below it and below it, by turns.
    lamps[n].middle_m = {across - 7.0f, 1.0f, n % 3 == 0 ? 2.0f : n % 3 == 1 ? -0.1f : -0.3f};
    lamps[n].radius_m = 0.2f;
    lamps[n].axis = {0.0f, 0.0f, n % 2 ? -1.0f : 0.3f};
    lamps[n].power = 1.0f + across;
  }
  LampWeights weights;
  LampRow(lamps).weigh({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 0.0f, weights);
  std::vector<int> drawn(lamps.size());
  constexpr int draws = 1 << 16;
  for (int n = 0; n < draws; ++n) ++drawn.at(weights.drawn((static_cast<float>(n) + 0.5f) / draws));
  for (std::size_t n = 0; n < lamps.size(); ++n) {
    CAPTURE(n);
    CHECK(drawn[n] == doctest::Approx(draws * weights.chance(n)).epsilon(1e-3).scale(draws));
    CHECK((weights.chance(n) > 0.0f) == (n % 3 != 2));
  }
  CHECK(weights.drawn(0.99999994f) == 19);
  // No side is dark in the air.
  LampRow(lamps).weigh({0.0f, 0.0f, 0.0f}, glm::vec3(0.0f), 0.0f, weights);
  for (std::size_t n = 0; n < lamps.size(); ++n) CHECK(weights.chance(n) > 0.0f);
  // Position of a moving lamp at the ray's time.
  lamps.resize(1);
  lamps[0].way_m = {0.0f, 0.0f, -4.0f};
  LampRow(lamps).weigh({0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 1.0f}, 1.0f, weights);
  CHECK(weights.sum() == 0.0f);
}

TEST_CASE(
    "under a long row of lamps a wall has the sum of their light and little noise, for those are looked at that "
    "matter") {
  scene::SurfaceMaterial white, lamp;
  white.base_color = glm::vec3(0.6f);
  white.roughness = 1.0f;
  lamp.base_color = glm::vec3(0.0f);
  lamp.emission = glm::vec3(7.0f);
  scene::ResolvedScene scene;
  add_part(scene, wall(5.0f, 60.0f), white);
  // Flat lamps 1 m away, of which the further shine past the wall more than at it; and as many behind it.
  double share = 0.0;
  for (int n = 0; n < 60; ++n) {
    const float y0 = 0.3f + 0.9f * static_cast<float>(n), y1 = y0 + 0.3f, z = 0.1f;
    add_part(scene, {glm::vec3(4.0f, y0, -z), {4.0f, y1, -z}, {4.0f, y1, z}, {4.0f, y0, z}}, lamp);
    add_part(scene, {glm::vec3(6.0f, y1, -z), {6.0f, y0, -z}, {6.0f, y0, z}, {6.0f, y1, z}}, lamp);
    share += 2.0 * (of_corner(y1, z) - of_corner(y0, z));
  }
  const double known = 0.6 * 7.0 * share;
  const PictureMean mean = mean_of(traced(scene, needle({5.0, 0.0, 0.0}, 0.0, even_sky(0.0f)), direct(128)));
  CHECK(mean.sigma < 0.006 * known);
  CHECK(std::abs(mean.radiance.x - known) < 4.0 * mean.sigma);
}

TEST_CASE("a sky lights a wall by the integral of its radiance and the cosine") {
  auto sky = *even_sky(0.2f);
  sky.sun_direction = glm::normalize(glm::vec3(-0.6f, 0.5f, 0.3f));
  // One bright cloud, and brighter towards the top.
  for (std::uint32_t row = instant::SkyTable::rows / 2; row < instant::SkyTable::rows; ++row)
    for (std::uint32_t column = 0; column < instant::SkyTable::columns; ++column)
      sky.table.radiance[std::size_t{row} * instant::SkyTable::columns + column] *=
          1.0f + 0.1f * static_cast<float>(row) + (row > 44 && row < 50 && column < 9 ? 100.0f : 0.0f);
  scene::SurfaceMaterial white;
  white.base_color = glm::vec3(0.5f);
  white.roughness = 1.0f;
  scene::ResolvedScene scene;
  add_part(scene, wall(5.0f, 3.0f), white);
  double irradiance = 0.0, drawn_share = 0.0;
  constexpr int rings = 800, spokes = 800;
  const Sky light(sky);
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * spokes; ++j) {
      const glm::vec3 direction = from_angles(2.0f * (static_cast<float>(i) + 0.5f) / rings - 1.0f,
                                              pi * (static_cast<float>(j) + 0.5f) / spokes);
      irradiance += double(luminance(instant::sky_radiance(sky, direction)) * std::max(0.0f, -direction.x));
      drawn_share += double(light.pdf(direction));
    }
  const double solid_angle = 2.0 * std::numbers::pi / rings / spokes;
  CHECK(drawn_share * solid_angle == relative(1.0, 0.005));
  const double known = 0.5 / std::numbers::pi * irradiance * solid_angle;
  const PictureMean mean =
      mean_of(traced(scene, needle({5.0, 0.0, 0.0}, 0.0, std::make_shared<const instant::SkyLight>(sky)), direct(512)));
  CHECK(mean.sigma < 0.006 * known);
  CHECK(std::abs(mean.radiance.x - known) < 4.0 * mean.sigma + 1e-3 * known);
}

TEST_CASE("rough metal under the sun shines as Walter's microfacets say") {
  scene::SurfaceMaterial metal;
  metal.base_color = glm::vec3(0.9f);
  metal.metallic = 1.0f;
  for (const float roughness : {0.4f, 0.8f})
    for (const double aside_deg : {20.0, 50.0}) {
      metal.roughness = roughness;
      scene::ResolvedScene scene;
      add_part(scene, wall(5.0f, 3.0f), metal);
      auto sun = *even_sky(0.0f);
      sun.light_direction = glm::normalize(glm::vec3(-1.0f, 0.5f, 0.2f));
      sun.light_irradiance = glm::vec3(3.0f);
      const double aside = aside_deg * std::numbers::pi / 180.0;
      const PictureMean mean = mean_of(
          traced(scene, needle({5.0, 0.0, 0.0}, aside, std::make_shared<const instant::SkyLight>(sun)), direct(64)));
      // Written with tangents, as the paper has D and G; D's width is the square of the roughness.
      const glm::dvec3 l(sun.light_direction), v(-std::cos(aside), -std::sin(aside), 0.0), h = glm::normalize(l + v);
      const double a2 = std::pow(double(roughness), 4.0);
      const auto tangent2 = [](double cosine) { return 1.0 / (cosine * cosine) - 1.0; };
      const double d = a2 / (std::numbers::pi * std::pow(-h.x, 4.0) * std::pow(a2 + tangent2(-h.x), 2.0));
      // Height-correlated (Heitz), where the paper multiplies the two.
      const auto lambda = [&](double cosine) { return 0.5 * (std::sqrt(1.0 + a2 * tangent2(cosine)) - 1.0); };
      const double g = 1.0 / (1.0 + lambda(-l.x) + lambda(-v.x));
      const double f = 0.9 + 0.1 * std::pow(1.0 - glm::dot(h, v), 5.0);
      const double known = f * d * g / (4.0 * v.x * l.x) * -l.x * 3.0;
      CAPTURE(roughness);
      CAPTURE(aside_deg);
      CHECK(mean.radiance.x == relative(known, 0.01));
    }
}

TEST_CASE("a mirror shows a lamp as bright as it is") {
  scene::SurfaceMaterial mirror, lamp;
  mirror.base_color = glm::vec3(0.8f);
  mirror.metallic = 1.0f;
  mirror.roughness = 0.01f;
  lamp.base_color = glm::vec3(0.0f);
  lamp.emission = glm::vec3(7.0f);
  scene::ResolvedScene scene;
  add_part(scene, wall(5.0f, 3.0f), mirror);
  add_part(scene, {glm::vec3(1.0f, 1.0f, -2.0f), {1.0f, 6.0f, -2.0f}, {1.0f, 6.0f, 2.0f}, {1.0f, 1.0f, 2.0f}}, lamp);
  // Mirror image of the lamp, which fills the needle's view.
  const double aside = std::atan2(0.75, 1.0);
  const PictureMean mean = mean_of(traced(scene, needle({5.0, 0.0, 0.0}, aside, even_sky(0.0f)), direct(64)));
  const double fresnel_here = 0.8 + 0.2 * std::pow(1.0 - std::cos(aside), 5.0);
  CHECK(mean.radiance.x == relative(7.0 * fresnel_here, 0.005));
}

}  // namespace septet::raytrace
