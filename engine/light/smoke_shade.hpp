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

/// Share of the light that is left at this height below and within the smoke of those moments.
LIGHT_FN float below_smoke(vec3 moments, float height_m) {
  const float depth = max(moments.x, 1e-6f), mean_m = moments.y / depth;
  const float variance_m2 = max(moments.z / depth - mean_m * mean_m, 1e-2f);
  return exp(-moments.x * normal_share((mean_m - height_m) * inversesqrt(variance_m2)));
}

LIGHT_END

#endif
