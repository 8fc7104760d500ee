#version 460
#extension GL_GOOGLE_include_directive : require
#include "ice.glsl"
#include "ice_bump.glsl"

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 rest;
layout(location = 0) out vec4 result;

void main() { result = vec4(bumped(normalize(normal), relative, rest), dot(relative, ice.forward.xyz)); }
