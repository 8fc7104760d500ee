#ifndef SEPTET_LIGHT_SMOKE_SHADE_HPP
#define SEPTET_LIGHT_SMOKE_SHADE_HPP
/// Shade of smoke in the light of sun or moon, from a map across the light's direction.
///
/// A texel has three moments of the smoke along the light: its optical depth d, and the means over it of the height and of that height's square, times d.
/// Heights count towards the light, m. Moments add up and are mixed between texels; along the light the smoke is taken as a Gaussian of their mean and
/// variance. Above and below it that is exact; within, it is soft.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST int smoke_shade_side = 128;  ///< Texels along each side of the map.

/// Share of a normal distribution below x standard deviations, within 0.0002 (a logistic curve of an odd cubic).
LIGHT_FN float normal_share(float x) {
  const float bounded = clamp(x, -6.0f, 6.0f);
  return 1.0f / (1.0f + exp(-bounded * (1.5976f + 0.07056f * bounded * bounded)));
}

/// Optical depth between this height and the light, through smoke of those moments.
LIGHT_FN float smoke_above(vec3 moments, float height_m) {
  const float depth = max(moments.x, 1e-6f), mean_m = moments.y / depth;
  const float variance_m2 = max(moments.z / depth - mean_m * mean_m, 1e-2f);
  return moments.x * normal_share((mean_m - height_m) * inversesqrt(variance_m2));
}

/// Share of the light that is left at this height below and within the smoke of those moments.
LIGHT_FN float below_smoke(vec3 moments, float height_m) { return exp(-smoke_above(moments, height_m)); }

/// Share of the sun's light in a puff within smoke, in the mean over its own depth, from its outer side on; `depth`: from its middle towards the sun.
/// Light that is scattered goes on: of an albedo of 1 none is lost.
LIGHT_FN float sun_within_smoke(float depth, float own_depth, float albedo) {
  const float absorbed = sqrt(max(1.0f - albedo, 0.0f)), own = max(absorbed * own_depth, 1e-3f);
  return exp(-max(absorbed * depth - own, 0.0f)) * ((1.0f - exp(-own)) / own);
}

/// Share of light from all around in what is seen of smoke of that depth: all where it is thin; where it is thick, about a quarter of what its outside
/// would have, by the ray tracer, and more the whiter it is.
LIGHT_FN float around_within_smoke(float depth, float albedo) {
  const float absorbed = sqrt(max(1.0f - albedo, 0.0f));
  return mix(1.0f / (1.0f + 3.0f * absorbed), 1.0f, exp(-0.5f * absorbed * depth));
}

LIGHT_END

#endif
