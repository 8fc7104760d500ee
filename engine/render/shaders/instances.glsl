// One drawn instance. The host's twin is InstanceRecord in passes/draw_list.hpp.

struct Instance {
  vec4 row0, row1, row2;  // Rows of relative_from_object, scale included.
  vec4 tint;              // rgb: paint. a: how much of the material's emission shines.
  vec4 light;             // x: share of the sky that reaches it.
};

layout(set = 0, binding = 1, std430) readonly buffer Instances { Instance instances[]; };

vec3 placed(Instance instance, vec3 position) {
  vec4 p = vec4(position, 1.0);
  return vec3(dot(instance.row0, p), dot(instance.row1, p), dot(instance.row2, p));
}

// For a rotation after a scale S, normals turn by R·S⁻¹ = M·S⁻²; the columns of M carry S in their lengths.
vec3 turned_normal(Instance instance, vec3 normal) {
  mat3 m = transpose(mat3(instance.row0.xyz, instance.row1.xyz, instance.row2.xyz));
  return m * (normal / vec3(dot(m[0], m[0]), dot(m[1], m[1]), dot(m[2], m[2])));
}
