#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "ice.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;

layout(location = 0) out vec3 out_relative;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_rest;
layout(location = 3) flat out vec3 out_haze;  // Radiance of air: light from above, and of the sun.

void main() {
  out_relative = ice.origin.xyz + position;
  out_normal = normal;
  out_rest = rest;
  out_haze = 0.8 * (around(vec3(0.0, 0.0, 1.0)) + 0.12 * view.light_irradiance.rgb * ice.origin.w);
  float ahead = dot(out_relative, ice.forward.xyz);
  gl_Position = vec4(2.0 * dot(out_relative, ice.u.xyz) - ahead, 2.0 * dot(out_relative, ice.v.xyz) - ahead,
                     ice.forward.w, ahead);
}
