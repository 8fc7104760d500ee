#version 460

// Smooths stairs along edges: Lottes, "FXAA" (NVIDIA white paper, 2009), the variant that blurs along the edge's direction
// as four samples around the pixel show it.

layout(set = 0, binding = 5) uniform sampler2D image;
layout(push_constant) uniform Target { vec4 pixel; } target;  // xy: size of a pixel in texture coordinates.

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 result;

float luma(vec3 color) { return dot(color, vec3(0.299, 0.587, 0.114)); }
vec3 at(vec2 offset) { return textureLod(image, uv + offset * target.pixel.xy, 0.0).rgb; }

void main() {
  float nw = luma(at(vec2(-0.5, -0.5))), ne = luma(at(vec2(0.5, -0.5)));
  float sw = luma(at(vec2(-0.5, 0.5))), se = luma(at(vec2(0.5, 0.5)));
  vec3 middle = texelFetch(image, ivec2(gl_FragCoord.xy), 0).rgb;
  float m = luma(middle);
  float low = min(m, min(min(nw, ne), min(sw, se))), high = max(m, max(max(nw, ne), max(sw, se)));
  vec2 along = vec2((sw + se) - (nw + ne), (nw + sw) - (ne + se));
  vec2 direction = normalize(along + vec2(1e-6, 0.0));
  float shorter = max(min(abs(direction.x), abs(direction.y)) * 8.0, 1e-3);
  vec2 far = clamp(direction / shorter, -2.0, 2.0);
  vec3 close = 0.5 * (at(direction * 0.5) + at(-direction * 0.5));
  vec3 wide = 0.5 * close + 0.25 * (at(far) + at(-far));
  float l = luma(wide);
  vec3 smoothed = l < low || l > high ? close : wide;
  result = vec4(high - low < max(0.04, 0.1 * high) ? middle : smoothed, 1.0);
}
