#ifndef SEPTET_LIGHT_SNOW_HPP
#define SEPTET_LIGHT_SNOW_HPP
/// Snow on a surface: how much of it lies there, and the colour that it has.
///
/// `cover`: of the weather, 0 to 1. Snow lies on what looks up and sees the sky; leaves wither, and it lies on twigs whichever way their picture
/// looks. Wheels keep two tracks of a lane bare.

#include "engine/light/language.hpp"
#include "engine/light/ruts.hpp"

LIGHT_BEGIN

LIGHT_CONST vec3 snow_albedo = vec3(0.85f, 0.88f, 0.92f);

/// Share of a surface that holds snow, by the z of its normal.
LIGHT_FN float holds_snow(float up) { return smoothstep(0.35f, 0.8f, up); }

/// The same of leaves and twigs.
LIGHT_FN float twigs_hold_snow(float up) { return max(holds_snow(up), 0.35f); }

/// Share of the snow on a lane that wheels leave there; `u`: across the lane.
LIGHT_FN float snow_beside_ruts(float u) { return 0.3f + 0.7f * smoothstep(0.07f, 0.13f, from_rut(u)); }

/// The colour of leaves under a weather of that cover.
LIGHT_FN vec3 withered(vec3 albedo, float cover) {
  return mix(albedo, vec3(0.11f, 0.09f, 0.07f) * (0.4f + 2.0f * albedo.y), 0.9f * cover);
}

/// `lies`: share of the place on which snow lies.
LIGHT_FN vec3 snowy_albedo(vec3 albedo, float lies) { return mix(albedo, snow_albedo, lies); }

LIGHT_END

#endif
