#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice.glsl"
#include "ice_bump.glsl"

// 0: the nearest faces. 1: front faces behind the back face. 2: back faces behind those.
layout(constant_id = 0) const uint peel = 0;
// Light followed to these faces spreads over many of their waves between one pixel and the next: the waves count by
// half.
layout(constant_id = 1) const uint followed = 0;

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

void main() {
  float depth = dot(relative, ice.forward.xyz);
  result = vec4(bumped(normalize(normal), relative, rest, followed != 0 ? 0.5 : 1.0), depth);
  ivec2 at = ivec2(gl_FragCoord.xy);
  if (peel == 1) {
    float back = texelFetch(ice_back, at, 0).w;
    // Outside the body, faces beyond it lie behind its far end.
    if (depth <= (back > 0.0 ? back : ice.beyond.z) * (1.0 + 1e-5)) discard;
  } else if (peel == 2) {
    float front = texelFetch(ice_beyond, at, 0).w;
    if (front == 0.0 || depth < front) discard;
  }
}
