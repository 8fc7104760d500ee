#version 460
#extension GL_GOOGLE_include_directive : require
#include "shadow_cascade.glsl"
#include "instances.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 0) out vec4 out_uv_shown;

void main() {
  out_uv_shown = vec4(uv, shown);
  gl_Position = cascade.clip_from_relative * vec4(placed(position), 1.0);
}
