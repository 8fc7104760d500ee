#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec4 radiance_depth;
layout(location = 2) flat in vec4 shift_fog;
layout(location = 3) flat in vec3 fog;
layout(location = 0) out vec4 result;

void main() {
  float square = dot(at, at);
  if (square > 1.0) discard;
  // Gaussian out to two deviations, shifted to zero there; billows from the noise.
  float falloff = (exp2(-2.885 * square) - 0.1353) * 1.1565;
  float billows = 0.45 + 1.1 * textureLod(noise, at * 0.11 + shift_fog.xy, 0.0).r;
  float alpha = 1.0 - exp2(-1.4427 * radiance_depth.w * falloff * billows);
  vec3 radiance = radiance_depth.rgb * (1.1 - 0.25 * square - 0.2 * at.y * at.y);
  result = vec4(mix(radiance, fog, shift_fog.z) * alpha, alpha);
}
