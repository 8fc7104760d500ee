// What every pass of a view sees. The host's twin is ViewUniforms in passes/view_uniforms.hpp.
//
// Positions are relative to the eye, along the world's axes, metres. Radiance: see engine/instant/atmosphere.hpp.

#include "engine/light/fresnel.hpp"
#include "engine/light/language.hpp"

layout(set = 0, binding = 0, std140) uniform View {
  mat4 clip_from_relative;
  mat4 shadow_from_relative;  // To texture coordinates and depth of the near cascade.
  vec4 far_from_near;         // Texture coordinates of the far cascade: xy·near + zw.
  vec4 light_direction;    // xyz: to the sun or moon. w: side of a near cascade's texel, m.
  vec4 light_irradiance;   // rgb. w: share of their radiance with which lamps glare.
  vec4 sky_irradiance;     // rgb. w: halvings by the air per metre.
  vec4 ground_irradiance;  // rgb. w: night, 0 to 1.
  vec4 sun_direction;      // xyz. w: side of a far cascade's texel, m.
  vec4 sun_level;          // xy: the sun's direction on the level, unit. z: overcast, w: cloud cover.
  vec4 irradiance[7];      // rgb: of sky and ground, see engine/instant/sky_irradiance.hpp. [0].w: height of the lamps under roofs, m.
  vec4 ray_middle, ray_right, ray_down;  // Direction to a pixel: middle + right·x + down·y in NDC.
  vec4 billboard_right, billboard_up;    // xyz: the screen's axes. right.w: radians a pixel.
  vec4 weather;            // Wetness, snow cover, simulated time s, rain mm/h.
  vec4 wind;               // xy: drift of the clouds, m. z: number of headlights. w: share of the sky where the eye is.
  vec4 headlight_position[10];   // xyz relative. w: intensity.
  vec4 headlight_direction[10];  // xyz unit. w: main beam, 0 to 1.
  vec4 soot_x, soot_y, soot_z;  // Rows from relative places to cells of the soot.
  vec4 soot_size;               // xyz: cells. w: number of beacons.
  vec4 lamp_field;              // From relative places to the field's coordinates: xy·z + xy. w: how strongly lamps in the open light.
  vec4 lamp_hue;                // rgb. w: how strongly lamps under roofs light.
  vec4 road;    // xyz: normal of the road near the eye, w: its height along that from the eye.
  vec4 water;   // xy: the eye within a tile of puddles, m. z: 1 where mirror_image holds this view, w: where ripples hold rain.
  vec4 target;  // xy: a pixel as a share of the target's width and height. zw: the eye within a tile of ripples, tiles.
  vec4 offset;  // xy: of the samples of what stands still, NDC. z: how much of its depth it keeps. w: 1 where the sun or moon casts shadows that can be seen.
  vec4 beacon_position[4];   // xyz relative.
  vec4 beacon_intensity[4];  // rgb.
} view;

layout(set = 0, binding = 2) uniform sampler2D sky_table;
layout(set = 0, binding = 3) uniform sampler2DArrayShadow shadow_map;
layout(set = 0, binding = 4) uniform sampler2D noise;
layout(set = 0, binding = 5) uniform sampler2D image;
layout(set = 0, binding = 12) uniform sampler2D lamp_field;

// The texture holds the sky's table and one for each step of roughness: the twin of engine/instant/sky_by_roughness.hpp.
const float sky_tables = 6.0, roughness_per_step = 0.175;

// Row and column of the sky table for a direction.
vec2 sky_coordinates(vec3 direction) {
  float per_level = inversesqrt(max(dot(direction.xy, direction.xy), 1e-8));
  float cosine = dot(direction.xy, view.sun_level.xy) * per_level;
  return vec2(sqrt(max(0.0, 0.5 - 0.5 * cosine)), 0.5 + 0.5 * sign(direction.z) * sqrt(abs(direction.z)));
}

// Half a texel from a table's edges lies the middle of its outer texels: none is mixed with those of the next.
vec3 sky_in_table(vec3 direction, float table) {
  vec2 at = sky_coordinates(direction);
  at.y = (clamp(at.y, 0.5 / 64.0, 63.5 / 64.0) + table) * (1.0 / sky_tables);
  return textureLod(sky_table, at, 0.0).rgb;
}

vec3 sky_radiance(vec3 direction) { return sky_in_table(direction, 0.0); }

// Of sky and ground, what a surface of that roughness mirrors in that direction.
vec3 mirrored_sky(vec3 direction, float roughness) {
  return sky_in_table(direction, min(1.0 + floor(roughness * (1.0 / roughness_per_step) + 0.5), sky_tables - 1.0));
}

// Light of sky and ground on a surface that faces `n`.
vec3 irradiance_on(vec3 n) {
  float x = dot(view.sun_level.xy, n.xy), z2 = n.z * n.z;
  vec3 sum = view.irradiance[0].rgb + view.irradiance[1].rgb * n.z + view.irradiance[2].rgb * x + view.irradiance[3].rgb * (3.0 * z2 - 1.0) +
             view.irradiance[4].rgb * (x * n.z) + view.irradiance[5].rgb * (2.0 * x * x + z2 - 1.0) +
             view.irradiance[6].rgb * ((35.0 * z2 - 30.0) * z2 + 3.0);
  return max(sum, vec3(0.0));
}

// What fog between the eye and a place in that direction scatters: as bright as the sky behind it, and below the horizon as the sky just above.
vec3 fog_radiance(vec3 direction) { return sky_radiance(vec3(direction.xy, max(direction.z, 0.02))); }

// Haze under a roof is lit by the lamps there: `roofed_haze` of engine/instant/instant.hpp. `share_of_sky`: of the place, beside the eye's own.
vec3 fog_radiance(vec3 direction, float share_of_sky) {
  return mix(fog_radiance(direction), vec3(1.5, 1.3, 1.0) * (0.35 / pi), (1.0 - view.wind.w) * (1.0 - share_of_sky));
}

// Images hold the square root of linear light: a square decodes them.
vec4 decoded(vec4 texel) { return vec4(texel.rgb * texel.rgb, texel.a); }
