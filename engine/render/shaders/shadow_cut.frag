#version 460
#extension GL_GOOGLE_include_directive : require
#include "shadow_fade.glsl"

layout(constant_id = 10) const uint fading = 0;  // Some texels show another level of detail.

layout(set = 0, binding = 5) uniform sampler2D image;

void main() {
  if (fading != 0 && !casts_here()) discard;
  if (texture(image, uv_shown.xy).a < 0.5) discard;
}
