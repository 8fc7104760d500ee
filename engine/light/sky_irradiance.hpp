#ifndef SEPTET_LIGHT_SKY_IRRADIANCE_HPP
#define SEPTET_LIGHT_SKY_IRRADIANCE_HPP
/// Light of sky and ground on a surface, by the way that it faces: spherical harmonics of few orders, whose terms
/// engine/instant/sky_irradiance.hpp works out from the sky's table.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST int irradiance_terms = 7;

/// On a surface with this normal, a unit vector of the world; `sun_level`: unit, towards the sun. Never negative. With x level to the sun:
/// terms[0] + terms[1]·z + terms[2]·x + terms[3]·(3z² − 1) + terms[4]·x·z + terms[5]·(x² − y²) + terms[6]·(35z⁴ − 30z² + 3).
LIGHT_FN vec3 irradiance_on(const vec3 terms[irradiance_terms], vec2 sun_level, vec3 normal) {
  const float x = dot(sun_level, vec2(normal)), z2 = normal.z * normal.z;
  const vec3 sum = terms[0] + terms[1] * normal.z + terms[2] * x + terms[3] * (3.0f * z2 - 1.0f) +
                   terms[4] * (x * normal.z) + terms[5] * (2.0f * x * x + z2 - 1.0f) +
                   terms[6] * ((35.0f * z2 - 30.0f) * z2 + 3.0f);
  return max(sum, vec3(0.0f));
}

LIGHT_END

#endif
