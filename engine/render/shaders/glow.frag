#version 460

layout(location = 0) in vec2 at;
layout(location = 1) flat in vec3 color;
layout(location = 0) out vec4 result;

void main() {
  float square = dot(at, at);
  if (square > 1.0) discard;
  // Bright core in a wide, weak halo that ends at the circle's edge, as the eye judges brightness: by about the root.
  float root = (1.0 - square) * (1.0 - square) * (0.12 + 0.88 * exp2(-18.0 * square));
  result = vec4(color * (root * root), smoothstep(0.02, 0.1, root));
}
