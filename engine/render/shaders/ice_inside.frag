#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"

// Cracks and planes of air, clipped between the body's front and back faces (section 3.3 of the paper), at half of the
// resolution of these, as the paper's textures are coarser than its window.

layout(constant_id = 0) const uint quality = 0;
// 1 cracks alone, 2 air alone, 0 either: a software rasteriser runs both sides of a branch.
layout(constant_id = 1) const uint kind = 0;

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 place;  // Texture coordinates, and 1 for air, 2 for a mark.
layout(location = 3) flat in vec3 haze;
layout(location = 0) out vec4 result;

void main() {
  ivec2 at = 2 * ivec2(gl_FragCoord.xy);
  float front = texelFetch(ice_front, at, 0).w, back = texelFetch(ice_back, at, 0).w;
  float depth = dot(relative, ice.forward.xyz);
  if (front == 0.0 || depth < front || depth > back) discard;
  if (kind != 2 && place.z > 1.5) {
    result = vec4(1.0, 0.0, 0.0, 1.0);
    return;
  }
  vec3 n = normalize(normal), eye = normalize(relative);
  vec3 sunlight = view.light_irradiance.rgb * ice.origin.w;
  if (kind == 2 || (kind == 0 && place.z > 0.5)) {
    // Half of the density of the pattern of haze and bubbles (engine/effects/ice/air_pattern.hpp), faded out at a
    // grazing angle, which would reveal the plane.
    float alpha = 0.5 * textureLod(noise, place.xy * 1.7, 0.0).g * smoothstep(0.1, 0.5, abs(dot(n, eye)));
    result = vec4(haze * alpha, alpha);
    return;
  }
  // Unevenness of a broken face.
  vec2 q = place.xy * 9.0;
  n = normalize(n + 0.10 * vec3(cos(q.x + 1.3 * sin(q.y)), cos(1.4 * q.y + sin(0.7 * q.x)), sin(q.x - q.y)));
  n *= -sign(dot(n, eye) + 1e-6);
  // Light reflected on the side of the eye, and light transmitted from the other one.
  vec3 h = normalize(view.light_direction.xyz - eye);
  float shine = pow(abs(dot(n, h)), 90.0);
  vec3 radiance = sunlight * shine;
  float share = 0.0;
  if (quality != 0) {
    // Thin gap of air: twice a face's share, and total reflection beyond its limit.
    float once = fresnel(abs(dot(n, eye)), out_of_ice);
    // Cracks touch here and there.
    share = 0.8 * (2.0 * once / (1.0 + once)) * smoothstep(0.2, 0.6, textureLod(noise, place.xy * 0.23, 0.0).r);
    radiance += share * around(reflect(eye, n));
  } else {
    // The paper's way: transparent except for its highlight; bright surroundings count as a light, too.
    vec3 mirrored = around(reflect(eye, n));
    radiance += mirrored * 0.35 * smoothstep(0.6, 1.6, dot(mirrored, vec3(0.33)));
  }
  result = vec4(radiance, share);
}
