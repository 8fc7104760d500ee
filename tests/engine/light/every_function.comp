#version 460
#extension GL_GOOGLE_include_directive : require
#include "tests/engine/light/every_function.hpp"

layout(local_size_x = 50) in;
layout(set = 0, binding = 0, std430) readonly buffer Points { vec4 points[]; };  // Two a point.
layout(set = 0, binding = 1, std430) writeonly buffer Values { vec4 values[]; };  // Of each function at all points, one function after the other.

void main() {
  uint count = uint(points.length()) / 2u, i = gl_GlobalInvocationID.x, function = gl_GlobalInvocationID.y;
  values[function * count + i] = value_of(function, points[2u * i], points[2u * i + 1u]);
}
