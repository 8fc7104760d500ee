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

void main() {
  out_relative = ice.origin.xyz + position;
  out_normal = normal;
  out_rest = rest;
  gl_Position = view.clip_from_relative * vec4(out_relative, 1.0);
}
