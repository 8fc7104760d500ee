#version 460

// Smooths stairs along edges: Lottes, "FXAA" (NVIDIA white paper, 2009), the variant that blurs along the edge's
// direction, estimated from four samples around the pixel.

layout(set = 0, binding = 5) uniform sampler2D image;
layout(push_constant) uniform Target { vec4 pixel; } target;  // xy: size of a pixel in texture coordinates.

layout(location = 0) out vec4 result;

float luma(vec3 c) { return dot(c, vec3(0.299, 0.587, 0.114)); }
float luma_at(ivec2 at) { return luma(texelFetch(image, clamp(at, ivec2(0), textureSize(image, 0) - 1), 0).rgb); }

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec2 uv = gl_FragCoord.xy * target.pixel.xy;
  vec3 middle = texelFetch(image, at, 0).rgb;
  float nw = luma_at(at + ivec2(-1, -1)), ne = luma_at(at + ivec2(1, -1));
  float sw = luma_at(at + ivec2(-1, 1)), se = luma_at(at + ivec2(1, 1));
  float m = luma(middle);
  float low = min(m, min(min(nw, ne), min(sw, se))), high = max(m, max(max(nw, ne), max(sw, se)));
  bool edge = high - low >= max(0.04, 0.1 * high);
  vec2 along = vec2((sw + se) - (nw + ne), (nw + sw) - (ne + se));
  vec2 direction = normalize(along + vec2(1e-6, 0.0));
  float shorter = max(min(abs(direction.x), abs(direction.y)) * 8.0, 1e-3);
  vec2 far = clamp(direction / shorter, -2.0, 2.0);
  // Loop instead of a branch: a software rasteriser runs both sides of a branch, but leaves a loop when no pixel of a
  // group stays in it.
  vec3 close = vec3(0.0), wide = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    if (!edge) break;
    vec2 offset = (i < 2 ? 0.5 * direction : far) * ((i & 1) == 0 ? 1.0 : -1.0);
    vec3 tap = textureLod(image, uv + offset * target.pixel.xy, 0.0).rgb;
    if (i < 2) close += 0.5 * tap; else wide += 0.25 * tap;
  }
  wide += 0.5 * close;
  float l = luma(wide);
  vec3 smoothed = l < low || l > high ? close : wide;
  result = vec4(edge ? smoothed : middle, 1.0);
}
