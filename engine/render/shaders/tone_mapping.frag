#version 460
#extension GL_GOOGLE_include_directive : require
#include "engine/light/tone_curve.hpp"

layout(set = 0, binding = 5) uniform sampler2D radiance;
layout(push_constant) uniform Exposure { vec4 exposure; };  // x: from radiance to the tone curve.

layout(location = 0) out vec4 result;

void main() { result = vec4(display_code(texelFetch(radiance, ivec2(gl_FragCoord.xy), 0).rgb * exposure.x), 1.0); }
