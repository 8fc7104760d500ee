#pragma once
/// Irradiance of a surface from sky and ground, by its direction: spherical harmonics of few orders.
///
/// Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance Environment Maps" (2001), equation 10: for a
/// matt surface nine numbers describe the surroundings. The sky's table is symmetric about the sun's azimuth, so that
/// six of them remain; a bright horizon needs one of the fourth order, the one with rotational symmetry.

#include <array>

#include <glm/vec3.hpp>

#include "engine/light/sky_irradiance.hpp"

namespace septet::instant {

struct SkyTable;

/// Terms of light::irradiance_on (engine/light/sky_irradiance.hpp).
using SkyIrradiance = std::array<glm::vec3, light::irradiance_terms>;

/// Irradiance from three sources: the table above the horizon; an even glow from above for light that it does not hold,
/// so that a level surface receives `level_irradiance`; and an evenly bright ground, since objects on it hide the haze
/// that the table has below the horizon.
SkyIrradiance sky_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                             const glm::vec3& ground_radiance);

/// Surroundings of a wall along a street: upright things all round it, houses and trees, and the shadow that it throws.
struct Street {
  float hidden_share = 0.0f;            ///< Of the lowest sky, by upright things.
  glm::vec3 shaded_radiance{0.0f};      ///< Of an upright thing without the sun's light.
  glm::vec3 sunlit_radiance{0.0f};      ///< Addition by the sun, on one that faces the sun's azimuth.
  glm::vec3 ground_sun_radiance{0.0f};  ///< Share of the ground's that the sun gives, lost in the wall's shadow.
};

/// The same for a wall along a street. Towards the side away from the sun the wall sees sunlit things, and where it
/// faces there, before itself, ground in its own shadow. A level surface still receives `level_irradiance`.
SkyIrradiance street_irradiance(const SkyTable& table, const glm::vec3& level_irradiance,
                                const glm::vec3& ground_radiance, const Street& street);

}  // namespace septet::instant
