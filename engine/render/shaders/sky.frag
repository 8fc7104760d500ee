#version 460
#extension GL_GOOGLE_include_directive : require
#include "view.glsl"
#include "engine/light/clouds.hpp"

layout(constant_id = 0) const uint clouded = 0;
layout(constant_id = 1) const uint starry = 0;

layout(location = 0) in vec3 direction;
layout(location = 0) out vec4 result;

// Density of clouds; the square undoes the images' code.
float density_at(vec2 place) {
  float root = textureLod(noise, place, 0.0).r;
  return cloud_density(root * root, view.sun_level.w);
}

void main() {
  vec3 d = normalize(direction);
  vec3 radiance = sky_radiance(d);
  float toward_sun = dot(d, view.sun_direction.xyz);
  float clear = 1.0 - view.sun_level.z;

  // Sun's disc, 0.53° across, with the eye's glare around it.
  float disc = smoothstep(0.999985, 0.999992, toward_sun);
  float glare = exp2((toward_sun - 1.0) * 3000.0) * 3.0 + exp2((toward_sun - 1.0) * 260.0) * 0.5;
  vec3 sun_color = view.light_irradiance.rgb * (1.0 - view.ground_irradiance.w);

  float cover = 0.0;
  if (clouded != 0) {
    vec2 place = cloud_place(d, view.wind.xy);
    float density = density_at(place), beyond = density_at(cloud_sunward(place, view.sun_direction.xyz));
    vec3 white = cloud_radiance(density, beyond, toward_sun, view.light_irradiance.rgb, view.sky_irradiance.rgb);
    cover = cloud_hides(density, d.z, view.sun_level.z);
    radiance = mix(radiance, white, cover);
  }
  if (starry != 0) {
    // Stars: at most one in each cell of a fine grid over the sky, exactly a pixel large. Stars come out as the sun
    // sinks from 6 to 15 degrees below the horizon, and thin cloud hides them.
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
