// What standing lamps throw on a surface: the twin of lamplight in passes/lamp_field.hpp. w: how far a roofed place is lit by them here, 0 to 1.
vec4 standing_lamps(vec3 relative, vec3 n, float share_of_sky) {
  vec2 at = relative.xy * view.lamp_field.z + view.lamp_field.xy, edge = abs(at - 0.5);
  float fade = clamp((0.5 - max(edge.x, edge.y)) * 6.0, 0.0, 1.0);
  vec4 texel = textureLod(lamp_field, at, 0.0);
  float sum = abs(texel.w);
  float light = fade * (max(0.0, dot(texel.xyz, n)) + 0.25 * max(0.0, sum - length(texel.xyz)));
  bool roofed = texel.w < 0.0;
  light *= roofed ? view.lamp_hue.w * (1.0 - share_of_sky) : view.lamp_field.w * share_of_sky;
  return vec4(view.lamp_hue.rgb * light, roofed ? fade * min(1.0, 8.0 * sum * view.lamp_hue.w) : 0.0);
}
