#version 460

// bloom_down.frag for a picture of four samples a pixel: the mean of four pixels.

layout(set = 0, binding = 5) uniform sampler2DMS source;

layout(location = 0) out vec4 result;

void main() {
  ivec2 last = textureSize(source) - 1;
  vec3 sum = vec3(0.0);
  for (int i = 0; i < 16; ++i) {
    vec3 light = texelFetch(source, min(2 * ivec2(gl_FragCoord.xy) + ivec2(i & 1, (i >> 1) & 1), last), i >> 2).rgb;
    sum += min(max(light, vec3(0.0)), vec3(6e4));
  }
  result = vec4(sum / 16.0, 1.0);
}
