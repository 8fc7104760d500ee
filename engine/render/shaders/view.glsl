// Uniforms and images that every pass of a view reads, and the light of its sky.

#include "engine/light/fresnel.hpp"
#include "engine/light/lamplight.hpp"
#include "engine/light/language.hpp"
#include "engine/light/sky_irradiance.hpp"
#include "engine/light/sky_tables.hpp"
#include "engine/light/view_record.hpp"

layout(set = 0, binding = 0, std140) uniform View { ViewUniforms view; };

layout(set = 0, binding = 2) uniform sampler2D sky_table;
layout(set = 0, binding = 3) uniform sampler2DArrayShadow shadow_map;
layout(set = 0, binding = 4) uniform sampler2D noise;
layout(set = 0, binding = 5) uniform sampler2D image;
layout(set = 0, binding = 12) uniform sampler2D lamp_field;

// Row and column of the sky table for a direction.
vec2 sky_coordinates(vec3 direction) {
  float per_level = inversesqrt(max(dot(direction.xy, direction.xy), 1e-8));
  float cosine = dot(direction.xy, view.sun_level.xy) * per_level;
  return vec2(sqrt(max(0.0, 0.5 - 0.5 * cosine)), 0.5 + 0.5 * sign(direction.z) * sqrt(abs(direction.z)));
}

// Half a texel of margin keeps the samples within one table: the middle of its outer texels lies there.
vec3 sky_in_table(vec3 direction, float table) {
  vec2 at = sky_coordinates(direction);
  at.y = (clamp(at.y, 0.5 / 64.0, 63.5 / 64.0) + table) * (1.0 / sky_tables);
  return textureLod(sky_table, at, 0.0).rgb;
}

vec3 sky_radiance(vec3 direction) { return sky_in_table(direction, 0.0); }

// Sky and ground as reflected in that direction by a surface of that roughness.
vec3 mirrored_sky(vec3 direction, float roughness) {
  return sky_in_table(direction, sky_table_of(roughness));
}

#define HUES_OF(terms) \
  vec3[](terms[0].rgb, terms[1].rgb, terms[2].rgb, terms[3].rgb, terms[4].rgb, terms[5].rgb, terms[6].rgb)

// Light of sky and ground on a surface that faces `n`.
vec3 irradiance_on(vec3 n) { return irradiance_on(HUES_OF(view.irradiance), view.sun_level.xy, n); }

// The same where it stands along a street, between houses.
vec3 street_irradiance_on(vec3 n) { return irradiance_on(HUES_OF(view.street_irradiance), view.sun_level.xy, n); }

// Radiance of fog between the eye and a place in that direction: that of the sky behind it, and below the horizon that
// of the sky just above.
vec3 fog_radiance(vec3 direction) { return sky_radiance(vec3(direction.xy, max(direction.z, 0.02))); }

// Radiance of fog; haze under a roof is lit by the lamps there. `share_of_sky`: of the place, in addition to the eye's
// own.
vec3 fog_radiance(vec3 direction, float share_of_sky) {
  return mix(fog_radiance(direction), roofed_haze, roofed_between(view.wind.w, share_of_sky));
}

// Images hold the square root of linear light: a square decodes them.
vec4 decoded(vec4 texel) { return vec4(texel.rgb * texel.rgb, texel.a); }
