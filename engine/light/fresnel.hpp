#ifndef SEPTET_LIGHT_FRESNEL_HPP
#define SEPTET_LIGHT_FRESNEL_HPP
/// Share of light that an interface between two clear media reflects, of both polarisations in the mean.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_FN float fifth_power(float x) {
  const float x2 = x * x;
  return x2 * x2 * x;
}

/// Schlick's approximation ("An Inexpensive BRDF Model for Physically-based Rendering", 1994). `f0`: what is reflected straight on.
LIGHT_FN vec3 schlick(vec3 f0, float cosine) { return f0 + (1.0f - f0) * fifth_power(1.0f - cosine); }

/// Fresnel's equations. `cosine`: between the normal and the way, not negative. `eta`: the index before the interface over the one behind it.
/// 1 where all light is reflected.
LIGHT_FN float fresnel(float cosine, float eta) {
  const float square = 1.0f - eta * eta * (1.0f - cosine * cosine);
  const float behind = sqrt(max(square, 0.0f));
  const float s = (eta * cosine - behind) / (eta * cosine + behind);
  const float p = (eta * behind - cosine) / (eta * behind + cosine);
  return square <= 0.0f ? 1.0f : 0.5f * (s * s + p * p);
}

LIGHT_END

#endif
