#version 460

layout(set = 0, binding = 5) uniform sampler2D image;  // Views in all mirrors: radiance, before exposure.

layout(location = 0) in vec2 at;
layout(location = 1) flat in float reflectance;
layout(location = 0) out vec4 result;

void main() { result = vec4(textureLod(image, at, 0.0).rgb * reflectance, 1.0); }
