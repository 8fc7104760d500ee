#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec3 color;
layout(location = 2) flat in vec4 heights;
layout(location = 0) out vec4 result;

void main() {
  float grazing = heights.x / at.y;
  // A facet of the water sends the lamp to the eye if it is tilted by half of what the two angles to the road differ.
  float tilt = 0.5 * (grazing - heights.y / (heights.z - at.y)) / 0.06;
  float side = at.x * heights.z / (heights.w * at.y);
  float mirrored = 0.02 + 0.98 * fifth_power(1.0 - grazing);
  float share = exp2(-1.44 * (tilt * tilt + side * side));
  result = vec4(color * (mirrored * share), smoothstep(0.02, 0.1, share));
}
