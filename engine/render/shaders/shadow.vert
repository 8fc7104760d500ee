#version 460
#extension GL_GOOGLE_include_directive : require
#include "instances.glsl"

layout(push_constant) uniform Cascade { mat4 clip_from_relative; } cascade;

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 0) out vec2 out_uv;

void main() {
  out_uv = uv;
  gl_Position = cascade.clip_from_relative * vec4(placed(position), 1.0);
}
