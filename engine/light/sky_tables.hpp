#ifndef SEPTET_LIGHT_SKY_TABLES_HPP
#define SEPTET_LIGHT_SKY_TABLES_HPP
/// Which of the sky's tables is read (engine/instant/sky_by_roughness.hpp): the sky as it is seen, and behind it as surfaces of each step of roughness
/// mirror it, from a mirror on; the last is for all that is rougher.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST uint roughness_steps = 5u;
LIGHT_CONST float roughness_step = 0.175f;
LIGHT_CONST float sky_tables = 1.0f + float(roughness_steps);

/// 0 is the sky as it is seen.
LIGHT_FN float sky_table_of(float roughness) {
  return min(1.0f + floor(roughness * (1.0f / roughness_step) + 0.5f), float(roughness_steps));
}

LIGHT_END

#endif
