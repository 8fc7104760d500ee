#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "sunlit.glsl"

layout(location = 0) in vec2 at;
layout(location = 1) in vec3 relative;
layout(location = 2) flat in vec4 size;
layout(location = 3) flat in vec4 up;
layout(location = 0) out vec4 result;

const float reach = 1.6;

void main() {
  // Share of the sky hidden from the ground. A level surface at distance d from a long wall of height h loses the share
  // ½(1 − d/√(d² + h²)) of it, weighted by the cosine. Below a body, d from its edge, ½(1 − d/√(d² + c²)) is left,
  // through the gap c.
  const float round_m = 0.4;
  vec2 q = abs(at) - size.xy + round_m;
  float away = length(max(q, 0.0)) + min(max(q.x, q.y), 0.0) - round_m;
  float across = away > 0.0 ? size.z : size.w;
  float hidden = 0.5 * (1.0 - away * inversesqrt(away * away + across * across));
  const float left = 0.5 * (1.0 - reach / sqrt(reach * reach + 1.0));
  hidden = max(0.0, hidden - left) / (1.0 - left);
  // Only the sky's light is hidden: the darkening is the sky's share of all light that arrives here.
  const vec3 luminance = vec3(0.2126, 0.7152, 0.0722);
  float sky = dot(view.sky_irradiance.rgb, luminance) * up.w + 0.45 * (1.0 - up.w), facing = dot(up.xyz, view.light_direction.xyz);
  float sun = dot(view.light_irradiance.rgb, luminance) * up.w * max(0.0, facing) * sunlit(relative, up.xyz, abs(facing));
  float seen = exp2(-length(relative) * view.sky_irradiance.w);
  result = vec4(0.0, 0.0, 0.0, hidden * seen * sky / max(sky + sun, 1e-6));
}
