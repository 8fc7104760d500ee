#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Streaks { StreakRecord streaks[]; };

layout(location = 0) out float out_across;
layout(location = 1) flat out vec4 out_color;

void main() {
  StreakRecord streak = streaks[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, 0), vec2(1, 0), vec2(1, 1), vec2(-1, 0), vec2(1, 1), vec2(-1, 1));
  vec2 at = corners[gl_VertexIndex];
  vec3 place = streak.from_width.xyz + streak.along_opacity.xyz * at.y;
  // Width of at least a pixel, with an opacity that falls in proportion.
  float pixel_m = view.billboard_right.w * length(streak.from_width.xyz), width = max(streak.from_width.w, pixel_m);
  vec3 side = normalize(cross(streak.along_opacity.xyz, place)) * (0.5 * width);
  // Length of at least its width: a flake at rest is a disc.
  place += normalize(streak.along_opacity.xyz) * ((at.y - 0.5) * width);
  out_across = at.x;
  out_color = vec4(streak.radiance.rgb, streak.along_opacity.w * min(1.0, streak.from_width.w / pixel_m));
  gl_Position = view.clip_from_relative * vec4(place + side * at.x, 1.0);
}
