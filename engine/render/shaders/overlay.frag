#version 460

#extension GL_GOOGLE_include_directive : require
#include "engine/light/records.hpp"

layout(set = 0, binding = 5) uniform sampler2D image;
layout(push_constant) uniform Quad { QuadConstants quad; };

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 result;

// Distance from the outline of a rectangle with rounded corners, negative inside (Quilez, "2D distance functions").
float from_outline(vec2 at, vec2 half_size, float radius) {
  vec2 beyond = abs(at) - half_size + radius;
  return length(max(beyond, 0.0)) + min(max(beyond.x, beyond.y), 0.0) - radius;
}

// Frame rounded like a bar, lit from above; `uv` in pixels from its middle.
vec4 frame() {
  float width = quad.kind.y, radius = quad.kind.z;
  float outside = from_outline(uv, quad.uv.zw, radius), inside = from_outline(uv, quad.uv.zw - width, radius - width);
  float cover = clamp(0.5 - outside, 0.0, 1.0) * clamp(0.5 + inside, 0.0, 1.0);
  vec2 corner = max(abs(uv) - quad.uv.zw + radius, 0.0);
  float upward = -sign(uv.y) * corner.y / max(length(corner), 1e-3) * clamp(2.0 * inside / width - 1.0, -1.0, 1.0);
  return vec4(quad.color.rgb * (1.0 + 0.7 * upward), 1.0) * cover;
}

void main() {
  if (quad.kind.x > 1.5) result = frame();
  else result = quad.color * (quad.kind.x > 0.5 ? textureLod(image, uv, 0.0).a : 1.0);
}
