// The material of one draw. The host's twin is MaterialConstants in passes/surface_pass.hpp.

layout(push_constant) uniform Material {
  vec4 base_color;  // rgb, opacity.
  vec4 emission;    // rgb, roughness.
  vec4 surface;     // Metallic, reflectance at normal incidence, clear coat, takes paint.
  vec4 light;       // Share of the sky that the surface sees, retroreflection cd/(lx m²), columns and rows of pictures.
  vec4 more;        // Share of light from around, lit by night.
} material;
