#version 460

layout(set = 0, binding = 5) uniform sampler2D image;
layout(push_constant) uniform Quad { vec4 ndc, uv, color, kind; } quad;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 result;

void main() { result = quad.color * (quad.kind.x > 0.5 ? textureLod(image, uv, 0.0).a : 1.0); }
