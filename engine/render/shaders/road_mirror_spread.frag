#version 460

// Reflection in a road's film of water: the mirror image, spread upwards and downwards, since at so low an angle facets
// tilted to the side hardly turn light.

layout(set = 0, binding = 5) uniform sampler2D source;
layout(push_constant) uniform Spread { vec4 spread; };  // xy: size of the target, z: deviation, texels of the source.

layout(location = 0) out vec4 result;

void main() {
  float texel = 1.0 / float(textureSize(source, 0).y), deviation = spread.z;
  vec2 at = gl_FragCoord.xy / spread.xy;
  int side = clamp(int(ceil(1.25 * deviation)), 1, 16);
  float step = 2.2 / float(side), weights = 0.0;  // Step in deviations.
  vec4 sum = vec4(0.0);
  for (int i = -side; i <= side; ++i) {
    float off = float(i) * step, weight = exp2(-0.7213475 * off * off);
    sum += weight * textureLod(source, at + vec2(0.0, off * deviation * texel), 0.0);
    weights += weight;
  }
  result = sum / weights;
}
