#version 460
#extension GL_GOOGLE_include_directive : require
#include "engine/light/tone_curve.hpp"

// Tone mapping of each of a pixel's four samples before they are averaged: otherwise a glint that covers one of them
// would whiten the pixel.

layout(set = 0, binding = 5) uniform sampler2DMS radiance;
layout(push_constant) uniform Exposure { vec4 exposure; };  // x: from radiance to the tone curve.

layout(location = 0) out vec4 result;

void main() {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) sum += display_code(texelFetch(radiance, ivec2(gl_FragCoord.xy), i).rgb * exposure.x);
  result = vec4(0.25 * sum, 1.0);
}
