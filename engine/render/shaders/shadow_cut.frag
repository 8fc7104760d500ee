#version 460
layout(set = 0, binding = 5) uniform sampler2D image;
layout(location = 0) in vec2 uv;

void main() {
  if (texture(image, uv).a < 0.5) discard;
}
