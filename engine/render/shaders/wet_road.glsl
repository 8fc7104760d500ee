// Water on the road of a view: engine/light/wet_road.hpp, with the device's images of puddles, ripples and the mirror
// image.

#include "engine/light/wet_road.hpp"

// Mirror image of the road, at the road's pixels; alpha: coverage.
layout(set = 0, binding = 13) uniform sampler2D mirror_image;
layout(set = 0, binding = 19) uniform sampler2D mirror_spread; // Same image, spread by the film's roughness.
layout(set = 0, binding = 14) uniform sampler2D ripples;       // Slopes of water.

// Share of a place under water; in the distance, where a pixel is wider than a puddle, the mean.
float puddle(vec2 ground, float footprint_m, float rut, float wetness) {
  float share = puddle_share(wetness);
  float root = textureLod(noise, ground / puddle_tile_m, 0.0).r;
  return mix(puddle_at(root * root, rut, share), share, smoothstep(0.4, 2.5, footprint_m));
}

// Slope of the water's surface: rings of rain, faded out where pixels no longer resolve them.
vec2 ripple_slope(vec2 relative, float footprint_m) {
  return textureLod(ripples, relative + view.target.zw, 0.0).rg * (view.water.w * (1.0 - smoothstep(0.03, 0.3, footprint_m)));
}

// Mirror image of objects over the road as its water shows it, times their share of the reflected directions, which is
// alpha. The image shifts by about half of the angle by which a facet's tilt turns the ray. `under_water`: share of
// puddle instead of film.
vec4 mirrored_on_road(vec2 ahead, vec2 slope, float under_water) {
  vec2 at = gl_FragCoord.xy * view.target.xy;
  at.y += dot(slope, ahead) * view.target.y / view.billboard_right.w;
  return mix(textureLod(mirror_spread, at, 0.0), textureLod(mirror_image, at, 0.0), under_water) * view.water.z;
}
