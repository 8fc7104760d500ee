#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(location = 0) out vec3 out_direction;

// One triangle over the whole view, infinitely far away (depth 0).
void main() {
  vec2 ndc = vec2(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
  out_direction = view.ray_middle.xyz + view.ray_right.xyz * ndc.x + view.ray_down.xyz * ndc.y;
  gl_Position = vec4(ndc, 0.0, 1.0);
}
