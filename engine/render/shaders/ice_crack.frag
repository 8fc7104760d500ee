#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice.glsl"

// Cracks over the back faces' normals, which bend the light seen through them. The paper tried this and found it too
// much in full.

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

void main() {
  float front = texelFetch(ice_front, ivec2(gl_FragCoord.xy), 0).w;
  if (rest.z > 0.5 || front == 0.0 || dot(relative, ice.forward.xyz) < front) discard;
  vec3 n = normalize(normal);
  n *= sign(dot(n, relative));
  const float share = 0.2;
  result = vec4(n * share, share);
}
