// Share of the sun's light that arrives at a place: one of two cascades, four texels compared and blended by the sampler. `n`: away from the surface.
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
  return 1.0 - fade + fade * texture(shadow_map, at);
}
