#include "engine/instant/atmosphere.hpp"

#include <cmath>

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
