#include "engine/instant/adaptation.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

#include "engine/instant/atmosphere.hpp"
#include "engine/instant/headlight_beam.hpp"
#include "engine/instant/standing_lamps.hpp"
#include "engine/light/tone_curve.hpp"

namespace septet::instant {
namespace {

SkyLight light_under(double elevation_deg, double clouds, double snow = 0.0, double visibility_m = 50000.0) {
  Environment environment;
  environment.sun_azimuth_rad = 2.0;
  environment.sun_elevation_rad = glm::radians(elevation_deg);
  environment.cloud_cover = clouds;
  environment.snow_cover = snow;
  environment.visibility_m = visibility_m;
  return sky_light(environment);
}

float luminance_of(const glm::vec3& color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Displayed level ground of that albedo, without lamps.
float shown_ground(const SkyLight& light, float albedo) {
  const float level = luminance_of(light.sky_irradiance) +
                      luminance_of(light.light_irradiance) * std::max(0.0f, light.light_direction.z);
  return light.exposure * albedo * level / glm::pi<float>();
}

/// Sky of the display, the mean over a level surface's view.
float shown_sky(const SkyLight& light) {
  return light.exposure * luminance_of(light.sky_irradiance) / glm::pi<float>();
}

float code(float exposed) { return 255.0f * light::display_code(glm::vec3(exposed)).g; }

}  // namespace

TEST_CASE("an eye's gain grows and what it makes of light falls, at every step from noon to a moonless night") {
  Adaptation before = adaptation(200e3);
  double lux_before = 200e3;
  for (double lux = 190e3; lux > 1e-4; lux *= 0.97) {
    const Adaptation now = adaptation(lux);
    CAPTURE(lux);
    CHECK(now.gain() >= before.gain());
    CHECK(now.exposure >= before.exposure);
    CHECK(now.light_up >= before.light_up);
    CHECK(now.night >= before.night);
    CHECK(now.street_lamps >= before.street_lamps);
    CHECK(now.gain() * lux < before.gain() * lux_before);
    // No visible step: 3 % less light is never a tenth less, and otherwise slowly more.
    CHECK(now.gain() < 1.04f * before.gain());
    CHECK(now.night - before.night < 0.02f);
    before = now, lux_before = lux;
  }
  CHECK(before.exposure == most_exposure);
  CHECK(before.light_up == most_light_up);
}

TEST_CASE("under a closed cover sky and land never grow brighter as the sun sinks from 17 to -11 degrees") {
  float sky = 1e9f, land = 1e9f;
  for (double elevation = 17.0; elevation >= -11.0; elevation -= 0.1) {
    const SkyLight light = light_under(elevation, 1.0);
    CAPTURE(elevation);
    CHECK(shown_sky(light) <= 1.0001f * sky);
    CHECK(shown_ground(light, 0.2f) <= 1.0001f * land);
    sky = shown_sky(light), land = shown_ground(light, 0.2f);
    // Straight up and at the horizon before and behind the driver, not in the mean alone.
    CHECK(light.exposure * luminance_of(sky_radiance(light, {0, 0, 1})) < 2.0f * sky);
  }
  const float road = code(shown_ground(light_under(1.1, 1.0), 0.1f)),
              earlier = code(shown_ground(light_under(17.0, 1.0), 0.1f));
  CHECK(road >= 45.0f);
  CHECK(road <= earlier);
  CHECK(shown_sky(light_under(-40.0, 1.0)) <= 0.5f * shown_sky(light_under(-1.7, 1.0)));
}

TEST_CASE("land never grows brighter as the sun sinks, whatever the clouds, the snow and the air") {
  for (const double clouds : {0.0, 0.25, 0.6, 0.8, 1.0})
    for (const double snow : {0.0, 1.0})
      for (const double visibility_m : {300.0, 5e3, 1e5}) {
        float land = 1e9f;
        for (double elevation = 17.0; elevation >= -14.0; elevation -= 0.5) {
          const SkyLight light = light_under(elevation, clouds, snow, visibility_m);
          CAPTURE(elevation);
          CAPTURE(clouds);
          CAPTURE(visibility_m);
          CHECK(shown_ground(light, 0.2f) <= 1.001f * land);
          land = shown_ground(light, 0.2f);
        }
      }
}

TEST_CASE("a lamp is shown as bright beside the light around it as it is") {
  // Headlights give the road 30 m ahead some 12 lx; twilight's ground gives 400 lx the same gain as theirs.
  for (const double elevation : {20.0, 5.0, 1.1, -1.7, -5.0, -12.0}) {
    const SkyLight light = light_under(elevation, 1.0);
    const Adaptation own = adaptation(8000.0 *
                                      (luminance_of(light.sky_irradiance) +
                                       luminance_of(light.light_irradiance) * std::max(0.0f, light.light_direction.z)) /
                                      light.light_up);
    CHECK(light.light_up == doctest::Approx(own.light_up));
    CHECK(open_lamps_light_up(light) <= light.light_up);
  }
  // By day street lamps are out, and they are lit before it is dark.
  CHECK(light_under(5.0, 1.0).street_lamps == 0.0f);
  CHECK(open_lamps_light_up(light_under(5.0, 1.0)) == 1.0f);
  CHECK(light_under(-3.0, 1.0).street_lamps == 1.0f);
}

}  // namespace septet::instant
