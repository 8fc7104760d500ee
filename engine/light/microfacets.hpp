#ifndef SEPTET_LIGHT_MICROFACETS_HPP
#define SEPTET_LIGHT_MICROFACETS_HPP
/// Rough surfaces as microfacets: the GGX distribution (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007).

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Distribution of facets, by the cosine between theirs and the surface's normal. `alpha`: the square of the roughness.
LIGHT_FN float ggx_density(float cosine, float alpha) {
  const float a2 = alpha * alpha, d = cosine * cosine * (a2 - 1.0f) + 1.0f;
  return a2 / (pi * d * d);
}

/// Reflectance of a clear coat of lacquer, of index 1.5, straight on.
LIGHT_CONST float coat_reflectance = 0.04f;
LIGHT_CONST float coat_roughness = 0.1f;

LIGHT_END

#endif
