#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

// The glass of a mirror. The host's twin is GlassRecord in passes/mirror_pass.cpp.
struct Corner {
  vec4 position;  // Relative to the eye. w: reflectance.
  vec4 at;        // xy: in the picture of all mirrors, pixels.
};
layout(set = 0, binding = 1, std430) readonly buffer Glass { Corner corners[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) flat out float out_reflectance;

void main() {
  Corner corner = corners[gl_VertexIndex];
  out_at = corner.at.xy / vec2(textureSize(image, 0));
  out_reflectance = corner.position.w;
  gl_Position = view.clip_from_relative * vec4(corner.position.xyz, 1.0);
}
