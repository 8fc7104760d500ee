#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;

layout(location = 0) out vec3 out_relative;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec3 out_rest;

// Projects into the body's own rectangle; depth is reversed.
void main() {
  out_relative = ice.origin.xyz + position;
  out_normal = normal;
  out_rest = rest;
  float ahead = dot(out_relative, ice.forward.xyz);
  gl_Position = vec4(2.0 * dot(out_relative, ice.u.xyz) - ahead, 2.0 * dot(out_relative, ice.v.xyz) - ahead,
                     ice.forward.w, ahead);
}
