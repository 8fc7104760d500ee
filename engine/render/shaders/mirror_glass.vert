#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Glass { GlassRecord corners[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out float out_reflectance;

void main() {
  GlassRecord corner = corners[gl_VertexIndex];
  out_at = corner.at.xy / vec2(textureSize(image, 0));
  out_reflectance = corner.position.w;
  gl_Position = view.clip_from_relative * vec4(corner.position.xyz, 1.0);
}
