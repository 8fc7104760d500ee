#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Glows { GlowRecord glows[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec3 out_color;

void main() {
  GlowRecord glow = glows[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  vec2 at = corners[gl_VertexIndex];
  vec3 middle = glow.position_size.xyz;
  float distance_m = length(middle);
  // Never smaller than a few pixels, so that a distant lamp is seen wherever between pixels it lies; dimmed as it is
  // enlarged, since its light falls with the square of the distance. Moved towards the eye, out of its own housing.
  float radius = max(glow.position_size.w, distance_m * view.billboard_right.w * 3.2);
  middle *= 1.0 - min(0.5, (0.25 + 0.2 * radius) / distance_m);
  out_at = at;
  out_color = glow.color.rgb * (exp2(-distance_m * view.sky_irradiance.w) * (glow.position_size.w * glow.position_size.w / (radius * radius)));
  gl_Position = view.clip_from_relative *
                vec4(middle + (view.billboard_right.xyz * at.x + view.billboard_up.xyz * at.y) * radius, 1.0);
}
