// Light of lamps under a roof at a place above the road, from their light at the road: the lamps are nearer there, and
// the light grows by the fourth power of the ratio of the distances, since both cosines fall with the distance. The
// direction of the light gives the lamps' distance to the side.
vec3 above_road(vec3 toward, float sum, vec3 relative) {
  float lamps_m = view.irradiance[0].w, near = clamp(2.0 - length(relative) * 0.015, 0.0, 1.0);
  float height_m = near * clamp(dot(view.road.xyz, relative) - view.road.w, 0.0, 0.7 * lamps_m);
  float below = 1.0 - height_m / lamps_m, slant = sum / max(toward.z, 1e-6), aside = max(slant * slant - 1.0, 0.0);
  float nearer = (aside + 1.0) / (aside + below * below);
  return toward * vec3(1.0, 1.0, below) * (below * nearer * nearer);
}

// Light of standing lamps on a surface. w: share to which they light a roofed place here, 0 to 1.
vec4 standing_lamps(vec3 relative, vec3 n, float share_of_sky) {
  // A wall takes the light of the road before it: other lamps stand beyond.
  vec2 at = (relative.xy + 1.5 * n.xy) * view.lamp_field.z + view.lamp_field.xy, edge = abs(at - 0.5);
  float fade = clamp((0.5 - max(edge.x, edge.y)) * 6.0, 0.0, 1.0);
  vec4 texel = textureLod(lamp_field, at, 0.0);
  float sum = abs(texel.w), even = from_all_sides(texel);
  bool roofed = texel.w < 0.0;
  if (roofed) texel.xyz = above_road(texel.xyz, sum, relative);
  float light = fade * lamplight(texel.xyz, even, n);
  light *= roofed ? view.lamp_hue.w * (1.0 - share_of_sky) : view.lamp_field.w * share_of_sky;
  return vec4(view.lamp_hue.rgb * light, roofed ? fade * min(1.0, 8.0 * sum * view.lamp_hue.w) : 0.0);
}
