#include "engine/instant/sky_by_roughness.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

constexpr double turn_rad = 2.0 * std::numbers::pi;

/// Mirrored light of surfaces in a direction; the sun's azimuth is x.
glm::vec3 mirrored(const SkyLight& light, const SkyTable& table, const glm::vec3& direction) {
  SkyLight as_table;
  as_table.sun_direction = light.sun_direction;
  as_table.table = table;
  return sky_radiance(as_table, direction);
}

/// Mirrored light by a sum over the facets' half-sphere.
glm::dvec3 summed(const SkyLight& light, const glm::vec3& axis, double roughness) {
  const double alpha = roughness * roughness;
  const glm::vec3 across = glm::normalize(glm::vec3(-axis.y, axis.x, 0.0f)), along = glm::cross(axis, across);
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  constexpr int steps = 160;
  for (int i = 0; i < steps; ++i)
    for (int j = 0; j < steps; ++j) {
      // Half the angle from the axis to the light; D(h)·cos h·sin h, weighted with the light's cosine.
      const double half = (i + 0.5) / steps * 0.25 * turn_rad * 0.5, around = (j + 0.5) / steps * turn_rad;
      const double cosine = std::cos(half), d = cosine * cosine * (alpha * alpha - 1.0) + 1.0;
      const double counts = cosine * std::sin(half) / (d * d) * std::cos(2.0 * half);
      const auto sine = static_cast<float>(std::sin(2.0 * half));
      const glm::vec3 way = across * (sine * static_cast<float>(std::cos(around))) +
                            along * (sine * static_cast<float>(std::sin(around))) +
                            axis * static_cast<float>(std::cos(2.0 * half));
      const glm::vec3 seen =
          way.z > 0.0f ? sky_radiance(light, way) : light.ground_irradiance / static_cast<float>(0.5 * turn_rad);
      sum += counts * glm::dvec3(seen);
      weight += counts;
    }
  return sum / weight;
}

SkyLight low_sun() {
  Environment environment;
  environment.sun_elevation_rad = 0.1;
  environment.sun_azimuth_rad = 0.5 * std::numbers::pi;  // East, which is x.
  environment.visibility_m = 30e3;
  return sky_light(environment);
}

}  // namespace

TEST_CASE("what a surface mirrors is the sky's mean over its microfacets, for every roughness and direction") {
  const SkyLight light = low_sun();
  const std::array<SkyTable, light::roughness_steps> tables = sky_by_roughness(light);
  for (std::uint32_t step = 1; step < light::roughness_steps; ++step)
    for (const glm::vec3& way : {glm::vec3(0, 0.1f, 1), glm::vec3(1, 0, 0.3f), glm::vec3(-1, 0.4f, 0.1f),
                                 glm::vec3(0.2f, 1, -0.3f), glm::vec3(-0.6f, 0.5f, -1)}) {
      const glm::vec3 direction = glm::normalize(way);
      const glm::dvec3 expected = summed(light, direction, double(light::roughness_step) * step);
      const glm::vec3 found = mirrored(light, tables[step], direction);
      CAPTURE(step);
      CAPTURE(way.x);
      CAPTURE(way.z);
      CHECK(double(found.g) == relative(expected.g, 0.16));
    }
}

TEST_CASE("a mirror shows the sky's own table, and below the horizon the ground and not the haze before it") {
  const SkyLight light = low_sun();
  const std::array<SkyTable, light::roughness_steps> tables = sky_by_roughness(light), again = sky_by_roughness(light);
  const glm::vec3 up = glm::normalize(glm::vec3(1, 0, 0.2f)), down = glm::normalize(glm::vec3(1, 0, -0.1f));
  CHECK(mirrored(light, tables[0], up) == sky_radiance(light, up));
  CHECK(glm::distance(mirrored(light, tables[0], down), light.ground_irradiance / 3.14159f) <
        0.01f * glm::length(light.ground_irradiance));
  CHECK(mirrored(light, tables[0], down).g < 0.5f * sky_radiance(light, down).g);
  for (std::size_t step = 0; step < tables.size(); ++step) CHECK(tables[step].radiance == again[step].radiance);
}

}  // namespace septet::instant
