// Share of the sun's light that arrives at a place: one of two cascades, four texels compared and blended by the
// sampler, or sixteen where light grazes the surface, since a shadow's edge would show each texel many times as long.
// `n`: away from the surface.
//
// `unshaded`: no shadow of the light is visible, as `covered` below, but known in advance.
layout(constant_id = 13) const uint unshaded = 0;
layout(constant_id = 15) const uint soft_shadows = 0;  // Edges as wide as the sun makes them: for graphics cards.
layout(set = 0, binding = 15) uniform sampler2DArray shadow_depths;  // Shadow map, read without comparison.

// Position i of n points that lie evenly in a disc (Vogel, "A better way to construct the sunflower head", 1979).
vec2 in_disc(int i, int n) {
  float angle = 2.39996323 * float(i);
  return sqrt((float(i) + 0.5) / float(n)) * vec2(cos(angle), sin(angle));
}

// Percentage-closer soft shadows (Fernando, 2005) of a disc as wide as the sun: the height of the caster above the
// place gives the width of the shadow's edge. Deviation: casters too thin for the search are still compared, as narrow
// shadows are. `a`: the surface's normal in the near cascade's texture space.
float softly_lit(vec4 at, vec3 a, float texel_m) {
  const float sun_rad = 0.00465, farthest_m = 80.0;
  const int searched = 16, compared = 32;
  mat3 texture_from = mat3(view.shadow_from_relative);
  vec3 across = vec3(texture_from[0].x, texture_from[1].x, texture_from[2].x), along = vec3(texture_from[0].z, texture_from[1].z, texture_from[2].z);
  float texels = float(textureSize(shadow_map, 0).x), depth_per_m = length(along);
  // Plane of the surface around the place, as depth per texture coordinate, limited to 6 m along the light for 1 m
  // across.
  float near_over_far = at.z > 0.5 ? view.far_from_near.x : 1.0;
  float steepest = 6.0 * depth_per_m / (length(across) * near_over_far);
  vec2 plane = clamp(-a.xy / (sign(a.z) * max(abs(a.z), 1e-6)) * dot(along, along) / (dot(across, across) * near_over_far), vec2(-steepest), vec2(steepest));
  float widest = sun_rad * farthest_m / (texel_m * texels), above_m = 0.0, shading = 0.0;
  for (int i = 0; i < searched; ++i) {
    vec2 aside = widest * in_disc(i, searched);
    float above = textureLod(shadow_depths, vec3(at.xy + aside, at.z), 0.0).r - at.w - dot(plane, aside);
    if (above > 0.0) {
      above_m += above / depth_per_m;
      shading += 1.0;
    }
  }
  float radius = clamp(sun_rad * above_m / max(shading, 1.0) / (texel_m * texels), 1.2 / texels, max(widest, 1.2 / texels)), lit = 0.0;
  for (int i = 0; i < compared; ++i) {
    vec2 aside = radius * in_disc(i, compared);
    lit += texture(shadow_map, at + vec4(aside, 0.0, dot(plane, aside)));
  }
  return lit / float(compared);
}

float sunlit(vec3 relative, vec3 n, float facing) {
  if (unshaded != 0) return 1.0;
  // The receiver is moved off its surface by up to two texels of its cascade.
  vec3 near = (view.shadow_from_relative * vec4(relative, 1.0)).xyz;
  vec2 near_edge = abs(near.xy - 0.5);
  bool is_near = max(near_edge.x, near_edge.y) < 0.48;
  float texel_m = is_near ? view.light_direction.w : view.sun_direction.w;
  near += mat3(view.shadow_from_relative) * (n * (texel_m * (2.0 - 1.6 * facing)));
  vec2 far = near.xy * view.far_from_near.xy + view.far_from_near.zw;
  vec2 far_edge = abs(far - 0.5);
  float fade = is_near ? 1.0 : clamp((0.49 - max(far_edge.x, far_edge.y)) * 20.0, 0.0, 1.0);
  vec4 at = is_near ? vec4(near.xy, 0.0, near.z) : vec4(far, 1.0, near.z);
  // Loop instead of branches: a software device leaves it early. Under a closed cover no texel is compared.
  bool grazed = facing < 0.4;
  bool covered = view.offset.w == 0.0;
  if (soft_shadows != 0) return covered ? 1.0 : 1.0 - fade + fade * softly_lit(at, mat3(view.shadow_from_relative) * n, texel_m);
  int samples = covered ? 0 : grazed ? 4 : 1;
  float spacing = grazed ? 1.5 / float(textureSize(shadow_map, 0).x) : 0.0;
  float lit = samples == 0 ? 1.0 : 0.0;
  for (int i = 0; i < samples; ++i)
    lit += texture(shadow_map, at + vec4((vec2(i & 1, i >> 1) - 0.5) * spacing, 0.0, 0.0));
  return 1.0 - fade + fade * lit / float(max(samples, 1));
}
