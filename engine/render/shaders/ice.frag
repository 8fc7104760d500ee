#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"
#include "ice_bump.glsl"

// Front faces of ice: the light seen through them, the inside, and the reflection.

layout(constant_id = 0) const uint quality = 0;
layout(constant_id = 1) const uint two_sided = 0;
layout(constant_id = 2) const uint filled = 0;  // Cracks or air are inside.
layout(constant_id = 3) const uint frosted = 0;
layout(constant_id = 4) const uint beyond = 0;  // Other ice behind is seen through it, too.
layout(constant_id = 5) const uint shown = 0;   // Instead of ice: 1 depth of front faces, 2 of back faces.

layout(constant_id = 6) const uint thin = 0;    // The background is seen at its place, unrefracted.

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

bool is_inside(vec3 place, out ivec2 texel) {
  float depth = dot(place, ice.forward.xyz);
  texel = ivec2(floor(vec2(dot(place, ice.u.xyz), dot(place, ice.v.xyz)) / depth * vec2(textureSize(ice_front, 0))));
  if (any(lessThan(vec2(texel), ice.rectangle.xy)) || any(greaterThanEqual(vec2(texel), ice.rectangle.zw))) return false;
  float slack = 1e-3 * ice.absorption.w;
  float front = texelFetch(ice_front, texel, 0).w;
  if (front > 0.0 && depth >= front - slack && depth <= texelFetch(ice_back, texel, 0).w + slack) return true;
  if (beyond == 0) return false;
  front = texelFetch(ice_beyond, texel, 0).w;
  return front > 0.0 && depth >= front - slack && depth <= texelFetch(ice_beyond_back, texel, 0).w + slack;
}

// Takes a face if it is nearer than the held one, and light along `way` passes it outwards (`outwards` 1) or inwards
// (−1).
void consider(vec4 face, float depth, vec3 way, float outwards, inout float nearest, inout vec3 n) {
  float apart = abs(depth - face.w);
  if (face.w > 0.0 && dot(face.xyz, way) * outwards > 0.0 && apart < nearest) {
    nearest = apart;
    n = face.xyz;
  }
}

// Normal of the face that light meets here; of length 0 if there is none.
vec3 face_normal(ivec2 texel, float depth, vec3 way, float outwards) {
  texel = clamp(texel, ivec2(ice.rectangle.xy), ivec2(ice.rectangle.zw) - 1);
  float nearest = 1e30;
  vec3 n = vec3(0.0);
  consider(texelFetch(ice_front, texel, 0), depth, way, outwards, nearest, n);
  consider(texelFetch(ice_back, texel, 0), depth, way, outwards, nearest, n);
  if (beyond != 0) {
    consider(texelFetch(ice_beyond, texel, 0), depth, way, outwards, nearest, n);
    consider(texelFetch(ice_beyond_back, texel, 0), depth, way, outwards, nearest, n);
  }
  return dot(n, n) > 0.0 ? normalize(n) : n;
}

// Light refracted along `way` into the body: marched through the layers (Oliveira and Brauwers, "Real-Time Refraction
// Through Deformable Objects", 2007) to the face where it leaves, or is totally reflected and goes on; after leaving it
// may meet ice again, which reflects a share.
vec3 followed(vec3 way) {
  const int steps = 24, halvings = 6, most_faces = beyond != 0 ? 8 : 5;
  vec3 place = relative, light = vec3(0.0), share = vec3(1.0);
  bool in_ice = true;
  for (int i = 0; i < most_faces; ++i) {
    float reach = in_ice ? max(ice.absorption.w, ice.beyond.y) : ice.beyond.x;
    ivec2 texel, last = ivec2(ice.rectangle.xy);
    float before = 0.0, after = 0.0;
    bool met = in_ice;
    for (int k = 1; k <= steps; ++k) {
      after = reach * float(k) / float(steps);
      if (is_inside(place + way * after, texel) != in_ice) {
        met = true;
        break;
      }
      before = after;
      last = texel;
    }
    if (!met) break;
    for (int k = 0; k < halvings; ++k) {
      float middle = 0.5 * (before + after);
      if (is_inside(place + way * middle, texel) == in_ice) {
        before = middle;
        if (in_ice) last = texel;
      } else {
        after = middle;
        if (!in_ice) last = texel;
      }
    }
    float length_m = in_ice ? before : after;
    if (length_m == 0.0 || !in_ice) is_inside(place + way * length_m, last);
    place += way * length_m;
    if (in_ice) share *= transmittance(ice.absorption.rgb, length_m);
    vec3 n = face_normal(last, dot(place, ice.forward.xyz), way, in_ice ? 1.0 : -1.0);
    if (dot(n, n) == 0.0) break;
    if (in_ice) {
      vec3 out_way = refracted(way, -n, out_of_ice);
      if (out_way == vec3(0.0)) {
        way = mirrored_way(way, n);
        continue;
      }
      way = out_way;
      if (beyond == 0) break;
      in_ice = false;
    } else {
      float mirrored = fresnel(abs(dot(way, n)), into_ice);
      light += share * mirrored * around(mirrored_way(way, n));
      share *= 1.0 - mirrored;
      way = refracted(way, n, into_ice);
      in_ice = true;
    }
  }
  return light + share * around(way);
}

void main() {
  vec3 eye = normalize(relative);
  vec3 n = bumped(normalize(normal), relative, rest, 1.0);
  float cosine = abs(dot(eye, n));
  vec2 at = vec2(dot(relative, ice.u.xyz), dot(relative, ice.v.xyz)) / dot(relative, ice.forward.xyz);
  if (shown != 0) {
    float depth = shown == 1 ? textureLod(ice_front, at, 0.0).w : textureLod(ice_back, at, 0.0).w;
    result = vec4(vec3(1.0 - clamp((depth - ice.forward.w) / ice.absorption.w, 0.0, 1.0)), 1.0);
    return;
  }
  // Roughness by the grain of the ground under a thin film: at a grazing angle the slopes that face the eye are seen.
  const float grain = 0.1;
  if (thin != 0) {
    n = normalize(n - grain * eye);
    cosine = abs(dot(eye, n));
  }
  // Normal limited to face the eye, since a bump that turns away is still seen.
  vec3 facing = dot(eye, n) < -0.02 ? n : normalize(n - (dot(eye, n) + 0.02) * eye);

  vec3 seen = vec3(0.0);
  // Share of the background that is hidden. A film keeps some of the background's light by total reflection, as water
  // darkens asphalt (Lekner and Dorf, "Why some things are darker when wet", 1988).
  float hidden = thin != 0 ? 0.3 : 1.0;
  if (quality != 0 && two_sided != 0) {
    seen = followed(refracted(eye, facing, into_ice));
  } else if (thin == 0) {
    vec3 turned = facing;
    if (two_sided != 0) turned = blended_normal(n, textureLod(ice_back, at, 0.0).xyz, ice.blend.x, ice.blend.y);
    seen = around(refracted(eye, turned, into_ice));
  }
  if (filled != 0) {
    vec4 inside = textureLod(ice_inside, at, 0.0);
    seen = seen * (1.0 - inside.a) + inside.rgb;
    hidden += (1.0 - hidden) * inside.a;
  }
  // Equation 4 of the paper, or Fresnel's.
  float share = (quality != 0 || thin != 0 ? fresnel(cosine, into_ice) : paper_fresnel(cosine)) * ice.blend.w;
  vec3 radiance = mix(seen, around(mirrored_way(eye, facing)), share);
  hidden += (1.0 - hidden) * share;
  vec3 h = normalize(view.light_direction.xyz - eye);
  vec3 sunlight = view.light_irradiance.rgb * ice.origin.w;
  radiance += sunlight * (pow(max(dot(n, h), 0.0), ice.beyond.w) * (ice.beyond.w * (1.5 / 220.0)) * ice.blend.w);
  if (frosted != 0) {
    vec3 light = sunlight * max(dot(n, view.light_direction.xyz), 0.0) / pi + 0.5 * (around(n) + around(vec3(0.0, 0.0, 1.0)));
    // The noise holds ranks, as square roots: the crust varies between thick and thin.
    float coarse = textureLod(noise, rest.xy * 0.7 + rest.z * 0.31, 0.0).r, fine = textureLod(noise, rest.yx * 5.3 - rest.z, 0.0).r;
    float crust = 0.7 * coarse * coarse + 0.3 * fine * fine;
    float covered = ice.blend.z * smoothstep(0.15, 0.85, crust);
    radiance = mix(radiance, 0.82 * light, covered);
    hidden += (1.0 - hidden) * covered;
  }

  float fog = 1.0 - exp2(-length(relative) * view.sky_irradiance.w);
  radiance = mix(radiance, fog_radiance(eye) * hidden, fog);
  result = vec4(radiance, hidden);
}
