#version 460

// Half as wide and high as the source: each texel is the mean of sixteen around it, without stairs when lights move
// (Jimenez, "Next Generation Post Processing in Call of Duty", 2014, is the wider form).

layout(set = 0, binding = 5) uniform sampler2D source;
// xy: texel of the source, zw: texel of the target, in texture coordinates.
layout(push_constant) uniform Sizes { vec4 sizes; };

layout(location = 0) out vec4 result;

void main() {
  vec2 at = gl_FragCoord.xy * sizes.zw;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 4; ++i) {
    vec3 light = textureLod(source, at + (vec2(i & 1, i >> 1) * 2.0 - 1.0) * sizes.xy, 0.0).rgb;
    sum += min(max(light, vec3(0.0)), vec3(6e4));  // NaN and infinity stay in their pixel.
  }
  result = vec4(0.25 * sum, 1.0);
}
