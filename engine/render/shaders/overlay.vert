#version 460

layout(push_constant) uniform Quad {
  vec4 ndc;    // Left, top, right, bottom.
  vec4 uv;     // The same in the atlas.
  vec4 color;  // sRGB, premultiplied.
  vec4 kind;   // x: 1 text from the atlas, 0 a plain box.
} quad;

layout(location = 0) out vec2 out_uv;

void main() {
  bool right = gl_VertexIndex == 1 || gl_VertexIndex == 2 || gl_VertexIndex == 4;
  bool bottom = gl_VertexIndex == 2 || gl_VertexIndex == 4 || gl_VertexIndex == 5;
  out_uv = vec2(right ? quad.uv.z : quad.uv.x, bottom ? quad.uv.w : quad.uv.y);
  gl_Position = vec4(right ? quad.ndc.z : quad.ndc.x, bottom ? quad.ndc.w : quad.ndc.y, 0.0, 1.0);
}
