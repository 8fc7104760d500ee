#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "material.glsl"

layout(constant_id = 0) const uint textured = 0;
layout(constant_id = 1) const uint cut = 0;     // Alpha cuts holes, both sides are drawn: 1 by coverage, 2 by pixels.
layout(constant_id = 2) const uint glossy = 0;  // Mirrors sun and sky.
layout(constant_id = 3) const uint blended = 0;

layout(location = 0) in vec3 relative;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec2 uv;
layout(location = 3) flat in vec4 color;
layout(location = 4) flat in vec4 emission;
layout(location = 0) out vec4 result;

// Share of the sun's light that arrives: one of two cascades, four texels compared and blended by the sampler.
float sunlit(vec3 n, float facing) {
  float slope = 1.0 - 0.8 * facing;
  vec3 near = (view.shadow_from_relative[0] * vec4(relative + n * (view.light_direction.w * 2.0 * slope), 1.0)).xyz;
  if (all(lessThan(abs(near.xy - 0.5), vec2(0.49)))) return texture(shadow_map, vec4(near.xy, 0.0, near.z));
  vec3 far = (view.shadow_from_relative[1] * vec4(relative + n * (view.sun_direction.w * 2.0 * slope), 1.0)).xyz;
  vec2 edge = abs(far.xy - 0.5);
  float fade = clamp((0.49 - max(edge.x, edge.y)) * 20.0, 0.0, 1.0);
  if (fade <= 0.0) return 1.0;
  return mix(1.0, texture(shadow_map, vec4(far.xy, 1.0, far.z)), fade);
}

// A dipped beam: wide to the sides, cut off above, falling with the square of the distance.
vec3 headlights(vec3 n) {
  vec3 sum = vec3(0.0);
  for (int i = 0; i < int(view.wind.z); ++i) {
    vec3 to_surface = relative - view.headlight_position[i].xyz;
    float square = dot(to_surface, to_surface);
    vec3 ray = to_surface * inversesqrt(square);
    vec3 axis = view.headlight_direction[i].xyz;
    float beam = smoothstep(0.72, 0.99, dot(ray, axis)) * (1.0 - smoothstep(-0.01, 0.02, ray.z - axis.z));
    float facing = max(0.0, -dot(n, ray)) * 0.9 + 0.1;
    sum += vec3(1.0, 0.93, 0.80) * (view.headlight_position[i].w * beam * facing / (square + 90.0));
  }
  return sum;
}

void main() {
  vec4 base = color;
  if (textured != 0) base *= texture(image, uv);
  float alpha = base.a;
  if (cut != 0) {
    // Sharpened so that the edge is a pixel wide whatever the mip level; coverage of the samples takes it from here.
    alpha = clamp((base.a - 0.5) / max(fwidth(base.a), 1e-3) + 0.5, 0.0, 1.0);
    if (alpha < (cut == 2 ? 0.5 : 0.05)) discard;
  }
  vec3 n = normalize(normal);
  if (cut != 0 && !gl_FrontFacing) n = -n;
  float distance_m = length(relative);
  vec3 to_eye = -relative / distance_m;
  vec3 albedo = base.rgb;
  float roughness = material.emission.w;
  float share_of_sky = emission.w;

  if (view.weather.y > 0.0)
    albedo = mix(albedo, vec3(0.85, 0.88, 0.92), view.weather.y * share_of_sky * smoothstep(0.35, 0.8, n.z));
  float wet = 0.0;
  if (glossy != 0 && material.surface.z > 0.5) {
    wet = view.weather.x * share_of_sky;
    albedo *= 1.0 - 0.45 * wet;
  }

  vec3 to_light = view.light_direction.xyz;
  float facing = dot(n, to_light);
  float lit = share_of_sky;
  if (facing > 0.0 || cut != 0) lit *= sunlit(n, abs(facing));
  float diffuse = max(facing, 0.0);
  if (cut != 0) diffuse = 0.75 * diffuse + 0.25 * abs(facing) + 0.1;  // Leaves let light through.
  vec3 sunlight = view.light_irradiance.rgb * lit;
  vec3 ambient = mix(view.ground_irradiance.rgb, view.sky_irradiance.rgb, 0.5 + 0.5 * n.z) * share_of_sky;
  ambient += vec3(1.5, 1.3, 1.0) * (0.35 * (1.0 - share_of_sky));  // The lamps of a roofed place.
  vec3 irradiance = sunlight * diffuse + ambient;
  if (view.wind.z > 0.0) irradiance += headlights(n);
  vec3 radiance = albedo * (1.0 - material.surface.x) * irradiance / pi;

  if (glossy != 0) {
    // Microfacets (GGX, with Kelemen's visibility 1/(4·vh²)) for the light, the sky's table for the mirror image.
    bool road = material.surface.z > 0.5;
    float r = mix(roughness, 0.12, wet);
    vec3 f0 = mix(vec3(mix(material.surface.y, 0.02, wet)), albedo, material.surface.x);
    float cosine = clamp(dot(n, to_eye), 0.0, 1.0);
    vec3 fresnel = f0 + (max(vec3(1.0 - r), f0) - f0) * pow(1.0 - cosine, 5.0);
    vec3 mirrored = reflect(-to_eye, n);
    if (road) mirrored = normalize(vec3(mirrored.xy, max(mirrored.z, 0.02)));
    vec3 around = sky_radiance(mirrored) * share_of_sky + vec3(0.15, 0.13, 0.10) * (1.0 - share_of_sky);
    radiance += fresnel * around * (road ? 0.5 * wet : 1.0 - 0.7 * r);
    vec3 h = normalize(to_light + to_eye);
    float a2 = r * r * r * r;
    float nh = max(dot(n, h), 0.0), vh = max(dot(to_eye, h), 1e-3);
    float d = nh * nh * (a2 - 1.0) + 1.0;
    vec3 shine = (f0 + (1.0 - f0) * pow(1.0 - vh, 5.0)) * (a2 / (pi * d * d) * 0.25 / (vh * vh));
    radiance += min(shine, vec3(40.0)) * sunlight * (max(facing, 0.0) * (road ? wet : 1.0));
    if (blended != 0) alpha = clamp(alpha + dot(fresnel, vec3(0.33)), 0.0, 1.0);
  }
  // A lamp seen by an eye that has adapted to the dark glares less than its radiance says.
  radiance += emission.rgb * (textured != 0 ? base.rgb : vec3(1.0)) / max(1.0, 0.35 * view.light_irradiance.w);

  float fog = 1.0 - exp(-distance_m * view.sky_irradiance.w);
  radiance = mix(radiance, sky_radiance(vec3(-to_eye.xy, max(-to_eye.z, 0.015))), fog);
  result = vec4(tone_mapped(radiance), alpha);
  if (blended != 0) result.rgb *= alpha;
}
