#version 460

// Smaller picture, smoothed by a tent of three by three of its texels, blended over a share of a larger one.

layout(set = 0, binding = 5) uniform sampler2D source;
layout(push_constant) uniform Sizes { vec4 sizes; };  // xy: size of the target, z: the share.

layout(location = 0) out vec4 result;

void main() {
  vec2 at = gl_FragCoord.xy / sizes.xy, texel = 1.0 / vec2(textureSize(source, 0));
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 9; ++i) {
    ivec2 off = ivec2(i % 3, i / 3) - 1;
    float weight = (off.x == 0 ? 2.0 : 1.0) * (off.y == 0 ? 2.0 : 1.0) / 16.0;
    sum += weight * textureLod(source, at + vec2(off) * texel, 0.0).rgb;
  }
  result = vec4(sum * sizes.z, sizes.z);
}
