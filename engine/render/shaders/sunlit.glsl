// Share of the sun's light that arrives at a place: one of two cascades, four texels compared and blended by the sampler; where light grazes the surface,
// a shadow's edge would show each texel many times as long, so that sixteen are. `n`: away from the surface.
float sunlit(vec3 relative, vec3 n, float facing) {
  // The receiver is moved off its surface by about two texels of the cascade that it lies in.
  vec3 near = (view.shadow_from_relative * vec4(relative, 1.0)).xyz;
  vec2 near_edge = abs(near.xy - 0.5);
  bool is_near = max(near_edge.x, near_edge.y) < 0.48;
  float texel_m = is_near ? view.light_direction.w : view.sun_direction.w;
  near += mat3(view.shadow_from_relative) * (n * (texel_m * (2.0 - 1.6 * facing)));
  vec2 far = near.xy * view.far_from_near.xy + view.far_from_near.zw;
  vec2 far_edge = abs(far - 0.5);
  float fade = is_near ? 1.0 : clamp((0.49 - max(far_edge.x, far_edge.y)) * 20.0, 0.0, 1.0);
  vec4 at = is_near ? vec4(near.xy, 0.0, near.z) : vec4(far, 1.0, near.z);
  // A loop, not branches: a device of software leaves it early. Under a closed cover nothing is looked up.
  bool grazed = facing < 0.4;
  int samples = view.light_irradiance.g < 0.002 * view.sky_irradiance.g ? 0 : grazed ? 4 : 1;
  float spacing = grazed ? 1.5 / float(textureSize(shadow_map, 0).x) : 0.0;
  float lit = samples == 0 ? 1.0 : 0.0;
  for (int i = 0; i < samples; ++i)
    lit += texture(shadow_map, at + vec4((vec2(i & 1, i >> 1) - 0.5) * spacing, 0.0, 0.0));
  return 1.0 - fade + fade * lit / float(max(samples, 1));
}
