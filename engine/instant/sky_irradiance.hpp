#pragma once
/// How much light of sky and ground arrives at a surface, by the way that it faces: spherical harmonics of few orders.
///
/// Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001), equation 10: a matt surface tells no more of
/// its surroundings than nine numbers. The sky's table is the same on both sides of the sun, so that six of them remain; a bright horizon asks for one
/// of the fourth order, the one that is the same all round.

#include <array>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace septet::instant {

struct SkyTable;

/// Irradiance on a surface with normal (x, y, z), where x points level to the sun and z up:
/// terms[0] + terms[1]·z + terms[2]·x + terms[3]·(3z² − 1) + terms[4]·x·z + terms[5]·(x² − y²) + terms[6]·(35z⁴ − 30z² + 3).
using SkyIrradiance = std::array<glm::vec3, 7>;

/// Of the table above the horizon, of what it does not hold, clouds, as an even glow from above, so that a level surface receives
/// `level_irradiance`, and of a ground that is as bright everywhere: things stand on it, it hides the haze that the table has below the horizon.
SkyIrradiance sky_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                             const glm::vec3& ground_radiance);

/// On a surface that faces `normal`, a unit vector of the world; `sun_level`: unit, towards the sun. Never negative.
glm::vec3 irradiance_on(const SkyIrradiance& irradiance, const glm::vec2& sun_level, const glm::vec3& normal);

}  // namespace septet::instant
