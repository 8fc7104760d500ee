#include "engine/instant/atmosphere.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/relative.hpp"

namespace septet::instant {
namespace {

SkyLight light_at(double elevation_rad, double clouds = 0.0, double visibility_m = 30000.0) {
  Environment environment;
  environment.sun_azimuth_rad = 0.5 * M_PI;  // East.
  environment.sun_elevation_rad = elevation_rad;
  environment.cloud_cover = clouds;
  environment.visibility_m = visibility_m;
  return sky_light(environment);
}

float brightness(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace

TEST_CASE("an azimuth of a quarter turn puts the sun in the east") {
  const SkyLight light = light_at(0.3);
  CHECK(light.sun_direction.x == doctest::Approx(std::cos(0.3)));
  CHECK(std::abs(light.sun_direction.y) < 1e-6f);
  CHECK(light.sun_direction.z == doctest::Approx(std::sin(0.3)));
}

TEST_CASE("clear sun and sky at noon are as bright as measured ones") {
  // Clear summer noon: about 80 to 110 klx from the sun on a surface that faces it, 8 to 25 klx from the sky.
  const SkyLight light = light_at(1.0);
  const float sun_lux = 8000.0f * brightness(light.light_irradiance),
              sky_lux = 8000.0f * brightness(light.sky_irradiance);
  CHECK(sun_lux > 70e3f);
  CHECK(sun_lux < 120e3f);
  CHECK(sky_lux > 6e3f);
  CHECK(sky_lux < 30e3f);
}

TEST_CASE("the sky is blue overhead and paler at the horizon") {
  const SkyLight light = light_at(0.8);
  const glm::vec3 zenith = sky_radiance(light, {0, 0, 1});
  const glm::vec3 horizon = sky_radiance(light, glm::normalize(glm::vec3(-1, 0.3f, 0.05f)));
  CHECK(zenith.b > 1.6f * zenith.r);
  CHECK(horizon.b / horizon.r < 0.75f * zenith.b / zenith.r);
  CHECK(brightness(horizon) > brightness(zenith));
}

TEST_CASE("the sun reddens and fades as it sinks") {
  const SkyLight high = light_at(0.8), low = light_at(0.05);
  CHECK(low.light_irradiance.r / low.light_irradiance.b > 2.0f * high.light_irradiance.r / high.light_irradiance.b);
  CHECK(brightness(low.light_irradiance) < 0.5f * brightness(high.light_irradiance));
}

TEST_CASE("a low sun gives the light that is told of it and not that light dimmed again by the air") {
  const auto brightness_of_sun = [](double elevation_rad, double illuminance_lux) {
    Environment environment;
    environment.sun_elevation_rad = elevation_rad;
    environment.sun_illuminance_lux = illuminance_lux;
    const SkyLight light = sky_light(environment);
    return double(brightness(light.light_irradiance) / light.light_up);
  };
  const double high = brightness_of_sun(0.75, 80000.0);
  CHECK(brightness_of_sun(0.05, 1500.0) / high == relative(1500.0 / 80000.0, 0.05));
  CHECK(brightness_of_sun(0.3, 35000.0) / high == relative(35000.0 / 80000.0, 0.05));
  // Leaving the exposure unchanged by day means the same sun, lower.
  CHECK(brightness_of_sun(0.05, 80000.0) < 0.5 * high);
}

TEST_CASE("a closed cover takes the sun's beam and the colour of the sky") {
  const SkyLight light = light_at(0.8, 1.0);
  CHECK(brightness(light.light_irradiance) < 0.05f * brightness(light_at(0.8).light_irradiance));
  const glm::vec3 zenith = sky_radiance(light, {0, 0, 1});
  CHECK(zenith.b / zenith.r < 1.25f);
}

TEST_CASE("night is dark and a moon stands opposite the sun") {
  const SkyLight light = light_at(-0.4);
  CHECK(light.night == doctest::Approx(1.0));
  CHECK(brightness(sky_radiance(light, {0, 0, 1})) < 0.01f * brightness(sky_radiance(light_at(0.8), {0, 0, 1})));
  CHECK(light.light_direction.x < 0.0f);
  CHECK(light.light_direction.z > 0.0f);
}

TEST_CASE("fog hides at its visibility all but a fiftieth of the contrast") {
  // Koschmieder: contrast falls to 2 % at the meteorological range.
  CHECK(std::exp(-light_at(0.8, 0.0, 400.0).fog_per_m * 400.0f) == relative(0.02, 0.01));
}

TEST_CASE("rain hides as much as its drops do, snow more, and neither where none falls") {
  Environment environment;
  environment.temperature_k = 283.0;
  CHECK(fall_extinction_per_m(environment) == 0.0);
  // Per km, for millimetres an hour.
  for (const std::array<double, 2>& row : {std::array{1.0, 0.31}, std::array{5.0, 0.92}, std::array{10.0, 1.46},
                                           std::array{25.0, 2.7}, std::array{50.0, 4.3}}) {
    environment.rain_mm_per_h = row[0];
    CHECK(1000.0 * fall_extinction_per_m(environment) == relative(row[1], 0.02));
  }
  environment.rain_mm_per_h = 2.0;
  const double rain = fall_extinction_per_m(environment);
  environment.temperature_k = 273.0;
  const double wet_snow = fall_extinction_per_m(environment);
  environment.temperature_k = 265.0;
  const double dry_snow = fall_extinction_per_m(environment);
  CHECK(wet_snow > 2.0 * rain);
  CHECK(dry_snow > wet_snow);
  for (const double nonsense : {-3.0, std::numeric_limits<double>::quiet_NaN(), 1e300}) {
    environment.rain_mm_per_h = nonsense;
    CHECK(fall_extinction_per_m(environment) >= 0.0);
    CHECK(fall_extinction_per_m(environment) < 4.0);
  }
}

TEST_CASE("light is finite for every elevation and weather") {
  for (double elevation = -1.5; elevation <= 1.5; elevation += 0.21)
    for (const double clouds : {0.0, 0.5, 1.0})
      for (const double visibility_m : {0.0, 60.0, 1e6}) {
        const SkyLight light = light_at(elevation, clouds, visibility_m);
        CHECK(std::isfinite(light.exposure));
        bool finite = true;
        for (const glm::vec3& radiance : light.table.radiance)
          finite = finite && std::isfinite(brightness(radiance)) && brightness(radiance) >= 0.0f;
        CHECK(finite);
      }
}

}  // namespace septet::instant
