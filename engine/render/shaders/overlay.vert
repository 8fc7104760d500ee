#version 460

#extension GL_GOOGLE_include_directive : require
#include "engine/light/records.hpp"

layout(push_constant) uniform Quad { QuadConstants quad; };

layout(location = 0) out vec2 out_uv;

void main() {
  bool right = gl_VertexIndex == 1 || gl_VertexIndex == 2 || gl_VertexIndex == 4;
  bool bottom = gl_VertexIndex == 2 || gl_VertexIndex == 4 || gl_VertexIndex == 5;
  out_uv = vec2(right ? quad.uv.z : quad.uv.x, bottom ? quad.uv.w : quad.uv.y);
  gl_Position = vec4(right ? quad.ndc.z : quad.ndc.x, bottom ? quad.ndc.w : quad.ndc.y, 0.0, 1.0);
}
