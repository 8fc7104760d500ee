#pragma once
/// How much light of sky and ground arrives at a surface, by the way that it faces: spherical harmonics of few orders.
///
/// Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001), equation 10: a matt surface tells no more of
/// its surroundings than nine numbers. The sky's table is the same on both sides of the sun, so that six of them remain; a bright horizon asks for one
/// of the fourth order, the one that is the same all round.

#include <array>

#include <glm/vec3.hpp>

#include "engine/light/sky_irradiance.hpp"

namespace septet::instant {

struct SkyTable;

/// Terms of light::irradiance_on (engine/light/sky_irradiance.hpp).
using SkyIrradiance = std::array<glm::vec3, light::irradiance_terms>;

/// Of the table above the horizon, of what it does not hold, clouds, as an even glow from above, so that a level surface receives
/// `level_irradiance`, and of a ground that is as bright everywhere: things stand on it, it hides the haze that the table has below the horizon.
SkyIrradiance sky_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                             const glm::vec3& ground_radiance);

}  // namespace septet::instant
