#version 460
#extension GL_GOOGLE_include_directive : require
#include "engine/light/records.hpp"

// Blend of this frame with the history of a pixel: see passes/temporal_pass.hpp.

layout(set = 0, binding = 5) uniform sampler2D radiance;   // This frame; alpha: marks.
layout(set = 0, binding = 17) uniform sampler2D history;   // Frame before, resolved; alpha: marks.
layout(set = 0, binding = 18) uniform sampler2D depth;     // Reversed; 0: the sky.
layout(push_constant) uniform Reprojection { ReprojectionConstants reprojection; };

layout(location = 0) out vec4 result;

// Weaker marks count as static: the clamp to the neighbours alone keeps them from trailing.
const float least_mark = 0.25;

// Compression to 0 to 1, so that one bright sample does not outweigh all others (Karis), and its inverse.
vec3 weighed(vec3 light) {
  light = max(light, vec3(0.0)) * reprojection.more.x;
  return light / (1.0 + max(light.r, max(light.g, light.b)));
}
vec3 unweighed(vec3 w) { return w / (max(1.0 - max(w.r, max(w.g, w.b)), 1e-4) * reprojection.more.x); }

// Frame before, between its pixels: Catmull and Rom's spline, which blurs less than linear interpolation, by five
// bilinear samples (Jimenez, "Filmic SMAA", 2016, leaves the corners out likewise).
vec3 seen_before(vec2 at) {
  vec2 size = vec2(textureSize(history, 0)), middle = floor(at - 0.5) + 0.5, f = at - middle;
  vec2 w0 = f * (-0.5 + f * (1.0 - 0.5 * f)), w3 = f * f * (-0.5 + 0.5 * f), w12 = 1.0 - w0 - w3;
  vec2 w2 = f * (0.5 + f * (2.0 - 1.5 * f));
  vec2 low = (middle - 1.0) / size, between = (middle + w2 / w12) / size, high = (middle + 2.0) / size;
  vec3 sum = vec3(0.0);
  float weight = 0.0;
  vec3 taps[5] = vec3[](vec3(between, w12.x * w12.y), vec3(low.x, between.y, w0.x * w12.y), vec3(high.x, between.y, w3.x * w12.y),
                        vec3(between.x, low.y, w12.x * w0.y), vec3(between.x, high.y, w12.x * w3.y));
  for (int i = 0; i < 5; ++i) {
    sum += taps[i].z * weighed(textureLod(history, taps[i].xy, 0.0).rgb);
    weight += taps[i].z;
  }
  return sum / weight;
}

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), last = textureSize(radiance, 0) - 1;
  vec4 now = texelFetch(radiance, at, 0);
  vec3 here = weighed(now.rgb), least = here, most = here;
  float nearest = 0.0;
  for (int i = 0; i < 9; ++i) {
    ivec2 beside = clamp(at + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
    vec4 light = texelFetch(radiance, beside, 0);
    vec3 w = weighed(light.rgb);
    least = min(least, w);
    most = max(most, w);
    if (light.a <= least_mark) nearest = max(nearest, texelFetch(depth, beside, 0).r);
  }
  // Colour of this frame alone: static surfaces are shifted back by the samples' offset; marked ones were not shifted.
  bool still = now.a <= least_mark;
  vec3 alone = still ? textureLod(radiance, (gl_FragCoord.xy + reprojection.more.zw) / vec2(last + 1), 0.0).rgb : now.rgb;
  result = vec4(alone, still ? 0.0 : 1.0);
  if (reprojection.more.y == 0.0 || !still) return;
  // An edge moves with the nearer surface.
  vec4 before = reprojection.before_from_now * vec4((gl_FragCoord.xy - reprojection.viewport.xy) / reprojection.viewport.zw * 2.0 - 1.0, nearest, 1.0);
  vec2 then = (before.xy / before.w * 0.5 + 0.5) * reprojection.viewport.zw;
  if (before.w <= 0.0 || any(lessThan(then, vec2(0.5))) || any(greaterThan(then, reprojection.viewport.zw - 0.5))) return;
  then += reprojection.viewport.xy;
  if (textureLod(history, then / vec2(textureSize(history, 0)), 0.0).a > least_mark) return;
  vec3 seen = clamp(seen_before(then), least, most);
  // Each resampling blurs a surface that moves over the screen a little: its history gets less weight.
  float share_of_now = mix(0.1, 0.25, clamp(0.5 * length(then - gl_FragCoord.xy), 0.0, 1.0));
  result.rgb = unweighed(mix(seen, here, share_of_now));
}
