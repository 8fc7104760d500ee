#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"
#include "engine/light/crack.hpp"
#include "engine/light/frost.hpp"

// Frost on a pane of glass, and cracks in it: premultiplied radiance, and share hidden. The sheet is so thin that the
// view through it is not displaced: it needs none of the layers of ice.frag.

layout(constant_id = 0) const uint cracked = 0;  // Cracks instead of frost.

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

// Mass of the frost here, and its variance within the pixel over its mean: detail finer than the pixel fades to its
// mean.
vec2 feathers(vec2 place, float pixel_m) {
  float fine = 1.0 - smoothstep(0.0007, 0.0020, pixel_m), coarse = 1.0 - smoothstep(0.004, 0.015, pixel_m);
  float unseen = 0.28 * (1.0 - fine) + 0.1 * (1.0 - coarse);
  if (coarse <= 0.0) return vec2(mean_feather_mass, unseen);
  float grain = textureLod(noise, place * frost_noise_per_m, 0.0).r;
  return vec2(feather_mass(feather_at(place), grain, fine, coarse), max(unseen, 1e-3));
}

// Irradiance from the whole hemisphere around a normal, over pi.
vec3 light_from(vec3 n) { return irradiance_on(n) / pi; }

vec4 frost(vec3 eye, vec3 n, vec3 place) {
  vec2 across = dFdx(place.xy), down = dFdy(place.xy);
  if (place.z < least_frost_kgpm2) return vec4(0.0);
  float pixel_m = sqrt(max(abs(across.x * down.y - across.y * down.x), 1e-12));
  vec2 lies = feathers(place.xy, pixel_m);
  float hidden = frost_hides_on_average(lies.x, lies.y, place.z);
  float share = frost_albedo * ice.origin.w;
  vec3 sunlight = view.light_irradiance.rgb * share;
  vec3 light = 0.5 * share * (light_from(n) + light_from(-n)) + 0.5 * sunlight * abs(dot(n, view.light_direction.xyz)) / pi;
  return vec4(light * hidden, hidden);
}

// Reflection on a face of a crack: sky above, ground below.
vec3 mirrored(vec3 way) {
  return mix(view.ground_irradiance.rgb / pi, sky_radiance(vec3(way.xy, max(way.z, 0.02))), smoothstep(-0.1, 0.1, way.z));
}

vec4 crack(vec3 eye, vec3 n, vec3 place) {
  float share = ice.origin.w;
  vec3 sunlight = view.light_irradiance.rgb * share;
  // Coverage: the crack's share of the pixel.
  float off = abs(place.y) / crack_width, soft = max(fwidth(place.y) / crack_width, 1e-4);
  if (place.z > 0.5) {
    // Each grain shows another piece of the surroundings.
    vec2 grain = crushed_grain(place.xy);
    float hidden = crushed_hides(grain, place.z);
    vec3 light = (0.25 + 1.5 * grain.y * grain.y) * share * (light_from(n) + light_from(-n)) +
                 grain.y * sunlight * abs(dot(n, view.light_direction.xyz)) / pi;
    return vec4(light * hidden, hidden);
  }
  // As the cracks of ice: a face that reflects light on both sides, totally at a grazing angle; its unevenness turns
  // the normal.
  n = uneven_crack(n, place.x);
  n *= -sign(dot(n, eye) + 1e-6);
  vec3 h = normalize(view.light_direction.xyz - eye);
  float shine = pow(abs(dot(n, h)), 40.0) * (40.0 * 1.5 / 220.0);
  float hidden = clamp((1.0 - off) / soft + 0.5, 0.0, 1.0) * min(1.0, 2.0 / soft) *
                 crack_hides(textureLod(noise, crack_noise_place(n, place.x), 0.0).r);
  vec3 light = 1.15 * mirrored(reflect(eye, n)) * share + sunlight * shine;
  return vec4(light * hidden, hidden);
}

void main() {
  vec3 eye = normalize(relative);
  vec4 lies = cracked != 0 ? crack(eye, normalize(normal), rest) : frost(eye, normalize(normal), rest);
  float fog = 1.0 - exp2(-length(relative) * view.sky_irradiance.w);
  result = vec4(mix(lies.rgb, fog_radiance(eye) * lies.a, fog), lies.a);
}
