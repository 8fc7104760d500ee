#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/puff.hpp"
#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Puffs { PuffRecord puffs[]; };

layout(location = 0) out vec2 out_at;  // In reaches.
layout(location = 1) flat out vec4 out_radiance_depth;
layout(location = 2) flat out vec4 out_shift_fog;  // xy: place in the noise. z: opacity of the fog before it. w: near2.
layout(location = 3) flat out vec3 out_fog;

void main() {
  PuffRecord puff = puffs[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  vec3 middle = puff.position_radius.xyz;
  float deviation = puff.position_radius.w, reach = puff_reach * deviation;
  float distance_m = max(length(middle), 1e-3), near2 = reach * reach / (distance_m * distance_m);
  vec2 at = puff_half_side(near2) * corners[gl_VertexIndex];
  vec3 to_eye = -middle / distance_m;
  // Faces the eye, not the screen, so that it is the same ball on the next screen.
  vec3 side = normalize(cross(abs(to_eye.z) < 0.99 ? vec3(0, 0, 1) : vec3(1, 0, 0), to_eye));
  vec3 up = cross(to_eye, side);
  out_at = at;
  out_radiance_depth = puff.radiance_depth;
  out_radiance_depth.w *= puff_shown(distance_m / deviation);
  out_fog = fog_radiance(-to_eye);
  out_shift_fog =
      vec4(puff.turn.x * 7.31, puff.turn.x * 3.77, 1.0 - exp2(-distance_m * view.sky_irradiance.w), near2);
  gl_Position = view.clip_from_relative * vec4(middle + (side * at.x + up * at.y) * reach, 1.0);
}
