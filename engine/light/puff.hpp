#ifndef SEPTET_LIGHT_PUFF_HPP
#define SEPTET_LIGHT_PUFF_HPP
/// A puff of smoke or spray: a ball whose density falls off as a Gaussian, and what a line through it loses.
///
/// A puff has an extinction area A, m², and a standard deviation σ, m. A line that passes its middle at distance b has the optical depth
/// A/(2πσ²)·e^(−b²/2σ²), whose integral over all such lines is A. A drawn puff ends at `puff_reach` deviations: there the fall-off is shifted to zero,
/// so that no rim shows, and raised so that the integral stays A. The pattern of its billows has the mean 1 over every puff.

#include "engine/light/language.hpp"

LIGHT_BEGIN

LIGHT_CONST float puff_reach = 3.0f;  ///< Radius of what is drawn, in deviations.
/// e^(−reach²/2), and 1 over what is left of the integral: 1 − rim·(1 + reach²/2).
LIGHT_CONST float puff_rim = 0.011108997f, puff_raised = 1.0650756f;

/// Density at a distance from the middle over that in the middle; `deviations2`: the square of that distance in deviations.
LIGHT_FN float puff_density(float deviations2) { return exp(-0.5f * deviations2); }

/// Optical depth along a line through the middle.
LIGHT_FN float puff_depth(float extinction_area_m2, float deviation_m) {
  return extinction_area_m2 / (2.0f * pi * deviation_m * deviation_m);
}

/// Depth of a line as drawn over that through the middle; `reach2`: the square of its distance from the middle in reaches.
LIGHT_FN float puff_falloff(float reach2) {
  return max(0.0f, puff_density(puff_reach * puff_reach * reach2) - puff_rim) * puff_raised;
}

/// The same square for the line from the eye to a place on the square that faces the eye through the middle. `across2`: the square of the place's
/// distance from the middle, `near2`: that of the reach over the distance of the middle from the eye.
LIGHT_FN float puff_passes(float across2, float near2) { return across2 / (1.0f + across2 * near2); }

/// Half of the side of such a square that holds the puff, in reaches. Near the eye, where none does, it goes on to 0.95 of the reach.
LIGHT_FN float puff_half_side(float near2) { return inversesqrt(max(1.0f - near2, 0.1f)); }

/// Density of billows, from the noise's ranks at two places that lie opposite to each other about the puff's middle: opposite places have the mean 1.
LIGHT_FN float puff_billows(float rank, float opposite_rank) { return 1.0f + 0.75f * (rank - opposite_rank); }

/// Radiance of smoke, opaque and of this albedo, by light that arrives there from single directions, which it scatters evenly to all sides.
LIGHT_FN vec3 puff_scatters(vec3 albedo, vec3 irradiance) { return albedo * irradiance / (4.0f * pi); }

/// Share of a puff that is drawn at a distance of its middle from the eye: from within, a square would be a wall.
LIGHT_FN float puff_shown(float distance_deviations) { return smoothstep(0.3f, 2.4f, distance_deviations); }

LIGHT_END

#endif
