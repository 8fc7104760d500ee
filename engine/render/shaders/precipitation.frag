#version 460

layout(location = 0) in float across;
layout(location = 1) flat in vec4 color;
layout(location = 0) out vec4 result;

void main() {
  float alpha = color.a * (1.0 - across * across);
  result = vec4(color.rgb * alpha, alpha);
}
