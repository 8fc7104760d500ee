#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "instances.glsl"
#include "material.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec2 uv;
layout(location = 2) in vec3 normal;
layout(location = 6) in vec4 tint;   // rgb: paint. a: how much of the material's emission shines.
layout(location = 7) in vec4 light;  // x: share of the sky that reaches it.

layout(location = 0) out vec3 out_relative;
layout(location = 1) out vec3 out_normal;
layout(location = 2) out vec2 out_uv;
layout(location = 3) flat out vec4 out_color;     // Base colour and opacity.
layout(location = 4) flat out vec4 out_emission;  // rgb, w: share of the sky.
layout(location = 5) out vec3 out_fog;

void main() {
  out_relative = placed(position);
  out_normal = turned_normal(normal);
  out_uv = uv;
  vec3 paint = material.surface.w > 0.5 ? tint.rgb : vec3(1.0);
  out_color = vec4(material.base_color.rgb * paint, material.base_color.a);
  out_emission = vec4(material.emission.rgb * tint.a, material.light.x * light.x);
  out_fog = fog_radiance(out_relative / max(length(out_relative), 1e-3));
  gl_Position = view.clip_from_relative * vec4(out_relative, 1.0);
}
