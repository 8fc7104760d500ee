#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Puffs { PuffRecord puffs[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out vec4 out_radiance_depth;
layout(location = 2) flat out vec4 out_shift_fog;  // xy: place in the noise. z: opacity of the fog before it.
layout(location = 3) flat out vec3 out_fog;

void main() {
  PuffRecord puff = puffs[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  vec2 at = corners[gl_VertexIndex];
  vec3 middle = puff.position_radius.xyz;
  float radius = puff.position_radius.w;
  float distance_m = length(middle);
  vec3 to_eye = -middle / max(distance_m, 1e-3);
  // Faces the eye, not the screen, so that it is the same ball on the next screen.
  vec3 side = normalize(cross(abs(to_eye.z) < 0.99 ? vec3(0, 0, 1) : vec3(1, 0, 0), to_eye));
  vec3 up = cross(to_eye, side);
  out_at = at;
  out_radiance_depth = puff.radiance_depth;
  // Thins out near the eye: from within it would be a wall.
  out_radiance_depth.w *= smoothstep(0.15, 1.2, distance_m / radius);
  out_fog = fog_radiance(-to_eye);
  out_shift_fog = vec4(puff.turn.x * 7.31, puff.turn.x * 3.77, 1.0 - exp2(-distance_m * view.sky_irradiance.w), 0.0);
  gl_Position = view.clip_from_relative * vec4(middle + (side * at.x + up * at.y) * radius, 1.0);
}
