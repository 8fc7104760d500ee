#include "engine/instant/sky_irradiance.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/instant/atmosphere.hpp"
#include "tests/relative.hpp"

namespace septet::instant {
namespace {

constexpr float pi = std::numbers::pi_v<float>;

glm::vec3 irradiance_on(const SkyIrradiance& terms, const glm::vec2& sun_level, const glm::vec3& normal) {
  return light::irradiance_on(terms.data(), sun_level, normal);
}

/// The radiance of the sky and of an even ground, weighed with the cosine, at 256 × 512 places.
glm::dvec3 summed(const SkyLight& light, const glm::vec3& normal) {
  constexpr int rows = 256, columns = 512;
  glm::dvec3 sum(0.0);
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double z = -1.0 + 2.0 * (row + 0.5) / rows, level = std::sqrt(1.0 - z * z);
      const double azimuth = 2.0 * std::numbers::pi * (column + 0.5) / columns;
      const glm::vec3 direction(level * std::cos(azimuth), level * std::sin(azimuth), z);
      const glm::vec3 radiance = z > 0.0 ? sky_radiance(light, direction) : light.ground_irradiance / pi;
      sum += glm::dvec3(radiance) * double(std::max(0.0f, glm::dot(direction, normal)));
    }
  return sum * (4.0 * std::numbers::pi / (rows * columns));
}

}  // namespace

TEST_CASE("between an even sky and an even ground a surface receives its share of both") {
  SkyTable table;
  table.radiance.assign(SkyTable::columns * SkyTable::rows, glm::vec3(2.0f));
  const SkyIrradiance irradiance = sky_irradiance(table, glm::vec3(2.0f * pi), glm::vec3(0.5f));
  for (const float z : {-1.0f, -0.5f, 0.0f, 0.7f, 1.0f}) {
    const glm::vec3 normal(0.6f * std::sqrt(1.0f - z * z), 0.8f * std::sqrt(1.0f - z * z), z);
    const float expected = pi * (2.0f * 0.5f * (1.0f + z) + 0.5f * 0.5f * (1.0f - z));
    CHECK(irradiance_on(irradiance, {1.0f, 0.0f}, normal).g == relative(expected, 0.01));
  }
}

TEST_CASE("seven numbers of a sky give the light on every side of a thing as a sum over the whole sky does") {
  for (const double elevation_rad : {-0.05, 0.05, 0.3, 0.9}) {
    Environment environment;
    environment.sun_azimuth_rad = 0.7;
    environment.sun_elevation_rad = elevation_rad;
    environment.cloud_cover = 0.0;
    const SkyLight light = sky_light(environment);
    const glm::vec2 sun_level = glm::normalize(glm::vec2(light.sun_direction));
    const double brightest = summed(light, {0, 0, 1}).g;
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = 0; z <= 1; ++z) {
          if (x == 0 && y == 0 && z == 0) continue;
          const glm::vec3 normal = glm::normalize(glm::vec3(x, y, z));
          CAPTURE(elevation_rad);
          CAPTURE(x);
          CAPTURE(y);
          CAPTURE(z);
          CHECK(std::abs(irradiance_on(light.irradiance, sun_level, normal).g - summed(light, normal).g) <
                0.05 * brightest);
        }
  }
}

TEST_CASE("houses and its own shadow change the light on a wall that turns from the sun, and not on level ground") {
  SkyTable table;
  table.radiance.assign(SkyTable::columns * SkyTable::rows, glm::vec3(1.0f));
  const glm::vec3 level(pi), ground(0.5f), away(-1, 0, 0), towards(1, 0, 0), up(0, 0, 1);
  const Street open{}, dark{.hidden_share = 0.8f, .shaded_radiance = glm::vec3(0.2f)},
      lit{.hidden_share = 0.8f, .shaded_radiance = glm::vec3(0.2f), .sunlit_radiance = glm::vec3(2.0f)},
      shadowed{.ground_sun_radiance = glm::vec3(0.4f)};
  const auto on = [&](const Street& street, const glm::vec3& normal) {
    return irradiance_on(street_irradiance(table, level, ground, street), {1.0f, 0.0f}, normal).g;
  };
  for (const glm::vec3& normal : {away, towards, up})
    CHECK(on(open, normal) ==
          relative(irradiance_on(sky_irradiance(table, level, ground), {1.0f, 0.0f}, normal).g, 1e-5));
  CHECK(on(dark, away) < 0.95f * on(open, away));
  CHECK(on(lit, away) > 1.1f * on(dark, away));
  CHECK(on(lit, away) > 1.1f * on(lit, towards));
  CHECK(on(shadowed, away) < 0.95f * on(open, away));
  // The ground fills half of its sight, and 0.7 of that straight away from the sun lies in its shadow.
  CHECK(on(shadowed, away) > on(open, away) - 0.7f * 0.4f * 0.5f * pi);
  for (const Street& street : {dark, lit, shadowed}) CHECK(on(street, up) == relative(pi, 1e-4));
}

TEST_CASE("in the sun a wall along a street that turns from it is lit with a warmer hue than one in a field") {
  for (const double elevation_rad : {0.25, 0.6, 1.0}) {
    Environment environment;
    environment.sun_elevation_rad = elevation_rad;
    environment.cloud_cover = 0.25;
    const SkyLight light = sky_light(environment);
    const glm::vec2 sun_level = glm::normalize(glm::vec2(light.sun_direction));
    const glm::vec3 away(-sun_level, 0.0f), street = irradiance_on(light.street_irradiance, sun_level, away),
                                            field = irradiance_on(light.irradiance, sun_level, away);
    CAPTURE(elevation_rad);
    CHECK(street.r / street.b > 1.02f * (field.r / field.b));
  }
}

TEST_CASE("at a low sun a wall that faces it receives much more of the sky's light than one that turns from it") {
  Environment environment;
  environment.sun_elevation_rad = 0.05;
  environment.cloud_cover = 0.0;
  const SkyLight light = sky_light(environment);
  const glm::vec2 sun_level = glm::normalize(glm::vec2(light.sun_direction));
  const glm::vec3 towards = irradiance_on(light.irradiance, sun_level, glm::vec3(sun_level, 0.0f)),
                  away = irradiance_on(light.irradiance, sun_level, glm::vec3(-sun_level, 0.0f));
  CHECK(towards.g > 1.5f * away.g);
  // And it is redder.
  CHECK(towards.r / towards.b > 1.2f * (away.r / away.b));
}

TEST_CASE("a level surface receives what the sky's light tells in every weather") {
  for (const double clouds : {0.0, 0.5, 1.0})
    for (const double elevation_rad : {-0.3, 0.02, 0.8}) {
      Environment environment;
      environment.sun_elevation_rad = elevation_rad;
      environment.cloud_cover = clouds;
      const SkyLight light = sky_light(environment);
      CHECK(irradiance_on(light.irradiance, {1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}).g ==
            relative(light.sky_irradiance.g, 1e-4));
    }
}

TEST_CASE("snow on the ground lights from below, about six times as much as grass does") {
  Environment environment;
  environment.cloud_cover = 1.0;
  const SkyLight bare = sky_light(environment);
  environment.snow_cover = 1.0;
  const SkyLight snowed = sky_light(environment);
  CHECK(snowed.ground_irradiance.g / bare.ground_irradiance.g == relative(6.3, 0.15));
  const glm::vec2 sun(1.0f, 0.0f);
  CHECK(irradiance_on(snowed.irradiance, sun, {0, 0, -1}).g > 4.0f * irradiance_on(bare.irradiance, sun, {0, 0, -1}).g);
  CHECK(irradiance_on(snowed.irradiance, sun, {1, 0, 0}).g > 1.4f * irradiance_on(bare.irradiance, sun, {1, 0, 0}).g);
  CHECK(snowed.sky_irradiance == bare.sky_irradiance);
}

}  // namespace septet::instant
