#ifndef SEPTET_LIGHT_CLOUDS_HPP
#define SEPTET_LIGHT_CLOUDS_HPP
/// Clouds: a sheet of noise over the land, and the light that it sends down.
///
/// They lie on a plane 1.6 km up and repeat after 9 km. The noise holds ranks, so that a share of the sky as large as the weather's cloud cover
/// lies above its limit. Directions are unit vectors along the world's axes, upwards.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST float cloud_height_m = 1600.0f;
LIGHT_CONST float cloud_tile_m = 9000.0f;

/// Place in the noise, tiles, where the sheet is seen. `drift_m`: how far it has been blown.
LIGHT_FN vec2 cloud_place(vec3 direction, vec2 drift_m) {
  return (vec2(direction.x, direction.y) * (cloud_height_m / (max(direction.z, 0.0f) + 0.12f)) + drift_m) /
         cloud_tile_m;
}

/// The place beside it that shades it. `sun_direction`: to the sun.
LIGHT_FN vec2 cloud_sunward(vec2 place, vec3 sun_direction) {
  return place + vec2(sun_direction.x, sun_direction.y) * 0.012f;
}

/// Density of the sheet where the noise has that rank, 0 to 1.
LIGHT_FN float cloud_density(float rank, float cloud_cover) {
  return smoothstep(1.0f - cloud_cover - 0.08f, 1.0f - cloud_cover + 0.34f, rank);
}

/// Its radiance; `beyond`: density at cloud_sunward. Irradiances of the sun or moon and of the sky.
LIGHT_FN vec3 cloud_radiance(float density, float beyond, float toward_sun, vec3 light_irradiance,
                             vec3 sky_irradiance) {
  const float lit = exp2(-1.5f * beyond - 0.5f * density);
  const float forward = max(toward_sun, 0.0f) * max(toward_sun, 0.0f);
  return light_irradiance * (0.46f * lit * (1.0f + 1.2f * forward * forward * forward)) +
         sky_irradiance * (0.24f + 0.16f * lit);
}

/// Share of what lies behind that it hides. `up`: z of the direction.
LIGHT_FN float cloud_hides(float density, float up, float overcast) {
  return density * smoothstep(0.015f, 0.16f, up) * (0.95f - 0.45f * overcast);
}

LIGHT_END

#endif
