#version 460
#extension GL_GOOGLE_include_directive : require
#include "shadow_fade.glsl"

void main() {
  if (!casts_here()) discard;
}
