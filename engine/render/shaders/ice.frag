#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"
#include "ice_bump.glsl"

// The front faces of ice: what is seen through them, what is inside, and what they mirror.

layout(constant_id = 0) const uint quality = 0;
layout(constant_id = 1) const uint two_sided = 0;
layout(constant_id = 2) const uint filled = 0;  // Cracks or air are inside.
layout(constant_id = 3) const uint frosted = 0;

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

// Both layers at a place, as distances along forward; x = 0 where the body is not.
vec2 faces_at(vec3 place, out ivec2 texel) {
  vec2 at = vec2(dot(place, ice.u.xyz), dot(place, ice.v.xyz)) / dot(place, ice.forward.xyz);
  texel = ivec2(floor(at * vec2(textureSize(ice_front, 0))));
  if (any(lessThan(vec2(texel), ice.rectangle.xy)) || any(greaterThanEqual(vec2(texel), ice.rectangle.zw)))
    return vec2(0.0);
  return vec2(texelFetch(ice_front, texel, 0).w, texelFetch(ice_back, texel, 0).w);
}

bool is_inside(vec3 place, out ivec2 texel) {
  vec2 faces = faces_at(place, texel);
  float depth = dot(place, ice.forward.xyz);
  return faces.x > 0.0 && depth >= faces.x - 1e-3 * ice.absorption.w && depth <= faces.y + 1e-3 * ice.absorption.w;
}

// Light on its way through the body, from `way` within: marched through the layers (Oliveira and Brauwers, "Real-Time
// Refraction Through Deformable Objects", 2007) to the face where it leaves, or is wholly reflected and goes on.
vec3 followed(vec3 way) {
  const int steps = 24, halvings = 6, most_reflections = 4;
  vec3 place = relative;
  float length_m = 0.0;
  for (int i = 0; i <= most_reflections; ++i) {
    ivec2 texel, last = ivec2(ice.rectangle.xy);
    float within = 0.0, beyond = 0.0;
    for (int k = 1; k <= steps; ++k) {
      beyond = ice.absorption.w * float(k) / float(steps);
      if (!is_inside(place + way * beyond, texel)) break;
      within = beyond;
      last = texel;
    }
    for (int k = 0; k < halvings; ++k) {
      float middle = 0.5 * (within + beyond);
      if (is_inside(place + way * middle, texel)) {
        within = middle;
        last = texel;
      } else {
        beyond = middle;
      }
    }
    if (within == 0.0) is_inside(place, last);
    place += way * within;
    length_m += within;
    last = clamp(last, ivec2(ice.rectangle.xy), ivec2(ice.rectangle.zw) - 1);
    vec4 front = texelFetch(ice_front, last, 0), back = texelFetch(ice_back, last, 0);
    float depth = dot(place, ice.forward.xyz);
    bool nearer = abs(depth - front.w) < abs(back.w - depth);
    vec3 n = nearer ? front.xyz : back.xyz;
    // At the rim the nearest face may be the wrong one of the two.
    if (dot(n, way) <= 0.0) n = nearer ? back.xyz : front.xyz;
    if (dot(n, n) == 0.0 || dot(n, way) <= 0.0) break;
    n = normalize(n);
    vec3 out_way = refracted(way, -n, out_of_ice);
    if (out_way != vec3(0.0)) {
      way = out_way;
      break;
    }
    way = reflect(way, n);
  }
  return around(way) * exp(-ice.absorption.rgb * length_m);
}

float exact_fresnel(float cosine) {
  float beyond = sqrt(max(1.0 - into_ice * into_ice * (1.0 - cosine * cosine), 0.0));
  float s = (into_ice * cosine - beyond) / (into_ice * cosine + beyond);
  float p = (into_ice * beyond - cosine) / (into_ice * beyond + cosine);
  return 0.5 * (s * s + p * p);
}

void main() {
  vec3 eye = normalize(relative);
  vec3 n = bumped(normalize(normal), relative, rest);
  float cosine = abs(dot(eye, n));
  vec2 at = vec2(dot(relative, ice.u.xyz), dot(relative, ice.v.xyz)) / dot(relative, ice.forward.xyz);
  // A bump may turn away from the eye; it is seen all the same.
  vec3 facing = dot(eye, n) < -0.02 ? n : normalize(n - (dot(eye, n) + 0.02) * eye);

  vec3 seen;
  if (quality != 0 && two_sided != 0) {
    seen = followed(refracted(eye, facing, into_ice));
  } else {
    vec3 turned = facing;
    if (two_sided != 0) {
      // Equation 1.
      vec3 sum = ice.blend.x * n + ice.blend.y * textureLod(ice_back, at, 0.0).xyz;
      if (dot(sum, sum) > 1e-6) turned = normalize(sum);
    }
    seen = around(refracted(eye, turned, into_ice));
  }
  if (filled != 0) {
    vec4 inside = textureLod(ice_inside, at, 0.0);
    seen = seen * (1.0 - inside.a) + inside.rgb;
  }
  // Equation 4, or Fresnel's.
  float share = (quality != 0 ? exact_fresnel(cosine) : (1.0 - cosine) * (1.0 - cosine) * (1.0 - cosine)) * ice.blend.w;
  vec3 radiance = mix(seen, around(reflect(eye, facing)), share);
  vec3 h = normalize(view.light_direction.xyz - eye);
  vec3 sunlight = view.light_irradiance.rgb * ice.origin.w;
  radiance += sunlight * (pow(max(dot(n, h), 0.0), 220.0) * 1.5 * ice.blend.w);
  if (frosted != 0) {
    vec3 light = sunlight * max(dot(n, view.light_direction.xyz), 0.0) / pi + 0.5 * (around(n) + around(vec3(0.0, 0.0, 1.0)));
    // The noise holds ranks, as square roots: a crust that is thick here and thin there.
    float coarse = textureLod(noise, rest.xy * 0.7 + rest.z * 0.31, 0.0).r, fine = textureLod(noise, rest.yx * 5.3 - rest.z, 0.0).r;
    float crust = 0.7 * coarse * coarse + 0.3 * fine * fine;
    radiance = mix(radiance, 0.82 * light, ice.blend.z * smoothstep(0.15, 0.85, crust));
  }

  float fog = 1.0 - exp2(-length(relative) * view.sky_irradiance.w);
  radiance = mix(radiance, fog_radiance(eye), fog);
  result = vec4(radiance, 1.0);
}
