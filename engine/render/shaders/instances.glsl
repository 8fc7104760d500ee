// Placement of a mesh by its instance.

#include "engine/light/instance_record.hpp"

vec3 placed(vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(row0, p), dot(row1, p), dot(row2, p));
}

vec3 turned(vec3 direction) {
  return vec3(dot(row0.xyz, direction), dot(row1.xyz, direction), dot(row2.xyz, direction));
}

// For a rotation after a scale S, normals turn by R·S⁻¹ = M·S⁻²; the columns of M carry S in their lengths.
vec3 turned_normal(vec3 normal) {
  mat3 m = transpose(mat3(row0.xyz, row1.xyz, row2.xyz));
  return m * (normal / vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2])));
}
