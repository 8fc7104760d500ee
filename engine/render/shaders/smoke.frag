#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/puff.hpp"

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 radiance_depth;
layout(location = 2) flat in vec4 shift_fog;
layout(location = 3) flat in vec3 fog;
layout(location = 0) out vec4 result;

// The noise holds roots of ranks.
float rank_at(vec2 place) {
  float root = textureLod(noise, place, 0.0).r;
  return root * root;
}

void main() {
  float square = puff_passes(dot(at, at), shift_fog.w);
  if (square > 1.0) discard;
  vec2 from_middle = 0.165 * at;
  float billows = puff_billows(rank_at(shift_fog.xy + from_middle), rank_at(shift_fog.xy - from_middle));
  float alpha = 1.0 - exp(-radiance_depth.w * puff_falloff(square) * billows);
  result = vec4(mix(radiance_depth.rgb, fog, shift_fog.z) * alpha, alpha);
}
