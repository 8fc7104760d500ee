#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

#include "engine/light/records.hpp"

layout(set = 0, binding = 1, std430) readonly buffer Contacts { ContactRecord contacts[]; };

layout(location = 0) out vec2 out_at;
layout(location = 1) out vec3 out_relative;
layout(location = 2) flat out vec4 out_size;  // Half length and width, height, clearance.
layout(location = 3) flat out vec4 out_up;    // xyz: unit; w: share of the sky.

const float reach = 1.6;  // Reach of the shadow in the body's heights.

void main() {
  ContactRecord contact = contacts[gl_InstanceIndex];
  const vec2 corners[6] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, -1), vec2(1, 1), vec2(-1, 1));
  vec2 half_size = vec2(contact.ahead.w, contact.aside.w);
  out_at = corners[gl_VertexIndex] * (half_size + reach * contact.middle.w);
  out_size = vec4(half_size, contact.middle.w, contact.light.x);
  out_up = vec4(cross(contact.ahead.xyz, contact.aside.xyz), contact.light.y);
  out_relative = contact.middle.xyz + contact.ahead.xyz * out_at.x + contact.aside.xyz * out_at.y;
  // Drawn 4 cm higher than it lies, along the line of sight, since roads are less flat than the rectangle.
  float nearer = min(0.05, 0.04 / max(abs(contact.middle.z), 0.3));
  gl_Position = view.clip_from_relative * vec4(out_relative * (1.0 - nearer), 1.0);
}
