#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"

layout(constant_id = 0) const uint clouded = 0;
layout(constant_id = 1) const uint starry = 0;

layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 result;

// The noise holds ranks: a share of the sky as large as the cover lies above its limit. The square undoes the images' code.
float cloud_density(vec2 at) {
  float rank = textureLod(noise, at, 0.0).r;
  float limit = 1.0 - view.sun_level.w;
  return smoothstep(limit - 0.08, limit + 0.34, rank * rank);
}

void main() {
  vec3 d = normalize(direction);
  vec3 radiance = sky_radiance(d);
  float toward_sun = dot(d, view.sun_direction.xyz);
  float clear = 1.0 - view.sun_level.z;

  // The sun's disc, 0.53° across, with the eye's glare around it.
  float disc = smoothstep(0.999985, 0.999992, toward_sun);
  float glare = exp2((toward_sun - 1.0) * 3000.0) * 3.0 + exp2((toward_sun - 1.0) * 260.0) * 0.5;
  vec3 sun_color = view.light_irradiance.rgb * (1.0 - view.ground_irradiance.w);

  float cover = 0.0;
  if (clouded != 0) {
    // Clouds on a plane 1.6 km up; the noise repeats after 9 km.
    vec2 at = (d.xy * (1600.0 / (max(d.z, 0.0) + 0.12)) + view.wind.xy) / 9000.0;
    float density = cloud_density(at);
    float beyond = cloud_density(at + view.sun_direction.xy * 0.012);
    float light = exp2(-1.5 * beyond - 0.5 * density);
    float forward = max(toward_sun, 0.0) * max(toward_sun, 0.0);
    vec3 white = view.light_irradiance.rgb * (0.46 * light * (1.0 + 1.2 * forward * forward * forward)) +
                 view.sky_irradiance.rgb * (0.24 + 0.16 * light);
    cover = density * smoothstep(0.015, 0.16, d.z) * (0.95 - 0.45 * view.sun_level.z);
    radiance = mix(radiance, white, cover);
  }
  if (starry != 0) {
    // At most one star in each cell of a fine grid over the sky, a point: as large as a pixel and no larger. Stars come out as the sun sinks from
    // 6 to 15 degrees below the horizon, and thin cloud hides them.
    vec3 cell = floor(d * 300.0);
    float seed = fract(sin(dot(cell, vec3(12.9898, 78.233, 37.719))) * 43758.5453);
    vec3 from_middle = d * 300.0 - cell - 0.5;
    float pixel = clamp(300.0 * length(fwidth(d)), 0.02, 0.5);
    float star = step(0.996, seed) * exp(-dot(from_middle, from_middle) / (0.3 * pixel * pixel)) * fract(seed * 917.0);
    float depth = 1.0 - smoothstep(-0.26, -0.104, view.sun_direction.z);
    radiance += vec3(smoothstep(0.0, 0.15, d.z) * star * 0.05 * depth * (1.0 - smoothstep(0.0, 0.3, cover)) * clear);
  }
  radiance += sun_color * ((disc * 60.0 + glare) * clear * step(-0.01, d.z) * (1.0 - 0.97 * cover));
  result = vec4(radiance, 0.0);
}
