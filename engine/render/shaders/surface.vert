#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "instances.glsl"
#include "material.glsl"

layout(constant_id = 7) const uint stripe = 0;
layout(constant_id = 9) const uint mirror_of_road = 0;
layout(constant_id = 10) const uint fading = 0;
// See passes/temporal_pass.hpp: 1 pixels with a history, 2 pixels of this frame alone.
layout(constant_id = 12) const uint over_frames = 0;

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 normal;
layout(location = 9) in vec4 vertex_color;
layout(location = 10) in vec4 tangent;  // All 0: it follows from the coordinates.
layout(location = 11) in vec2 second_uv;

layout(location = 0) out vec3 out_relative;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) out vec4 out_color;          // Base colour and opacity.
layout(location = 4) flat out vec4 out_emission;  // rgb, w: share of the sky.
layout(location = 5) out vec3 out_fog;
layout(location = 6) flat out float out_snowed;
layout(location = 7) flat out vec2 out_shown;
layout(location = 8) out vec2 out_second_uv;
layout(location = 9) out vec4 out_tangent;

// Moves a stripe's edge (see passes/stripes.hpp) outwards until the stripe reaches beyond the area that it covers by
// 0.75 pixels, so that every covered pixel has a sample. Returns the share by which it is drawn nearer to the eye,
// since it may sink into a road that is less flat.
float widen_stripe() {
  vec3 outwards = turned(normal);
  float half_width = length(outwards), side = 2.0 * uv.x - 1.0, distance_m = length(out_relative);
  outwards /= half_width;
  vec3 along = vec3(-outwards.y * side, outwards.x * side, uv.y);
  // Share of a displacement along `outwards` that lies across the plane through the eye and the stripe: it alone shifts
  // the edge on the screen.
  float share = abs(dot(outwards, normalize(cross(out_relative, along))));
  float pixel_m = min(view.billboard_right.w * distance_m / max(share, 1e-4), 3.0);
  float more_m = 0.75 * pixel_m;
  out_relative += outwards * more_m;
  out_normal = cross(outwards * side, along);
  out_uv = vec2(side * (half_width + more_m), half_width);
  return min(0.01, 0.03 * more_m / max(abs(out_relative.z), 0.3));
}

// Place of the mirror image in the road's water: below the road under the vehicle, or else under the eye.
vec3 below_road(vec3 place) {
  vec3 up = view.road.xyz;
  float road = light.w > -5000.0 ? dot(up, vec3(row0.w, row1.w, row2.w)) - light.w : view.road.w;
  return place - up * (2.0 * (dot(up, place) - road));
}

void main() {
  out_relative = placed(position);
  out_normal = turned_normal(normal);
  // One of several pictures in an image, that of this participant.
  float picture = mod(light.z, material.light.z * material.light.w);
  out_uv = (uv + vec2(mod(picture, material.light.z), floor(picture / material.light.z))) / material.light.zw;
  out_snowed = material.base_color.a < 0.999 ? 0.0 : light.y;
  out_shown = fading != 0 ? shown : vec2(0.0, 1.0);
  float nearer = 0.0;
  if (stripe != 0) nearer = widen_stripe();
  vec3 paint = material.surface.w > 0.5 ? tint.rgb : vec3(1.0);
  out_color = vec4(material.base_color.rgb * paint * vertex_color.rgb, material.base_color.a);
  out_second_uv = second_uv;
  // A mirrored instance changes the side of a normal map's green.
  bool mirrored = dot(cross(row0.xyz, row1.xyz), row2.xyz) < 0.0;
  out_tangent = vec4(turned(tangent.xyz), mirrored ? -tangent.w : tangent.w);
  out_emission = vec4(material.emission.rgb * (tint.a * mix(1.0, view.ground_irradiance.w, material.more.y)), material.light.x * light.x);
  out_fog = fog_radiance(out_relative / max(length(out_relative), 1e-3), out_emission.w);
  vec3 drawn = mirror_of_road != 0 ? below_road(out_relative) : out_relative * (1.0 - nearer);
  gl_Position = view.clip_from_relative * vec4(drawn, 1.0);
  if (over_frames == 1) {
    gl_Position.xy += view.offset.xy * gl_Position.w;
    gl_Position.z *= view.offset.z;
  }
}
