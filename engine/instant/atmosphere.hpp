#pragma once
/// Light of the sky: radiance and irradiance from sun, air and clouds at one instant, computed on the CPU.
///
/// Single scattering of sunlight by air molecules (Rayleigh), haze (Mie) and absorption by ozone through a spherical
/// atmosphere, integrated numerically for a table of directions; light that is scattered again is added as an even
/// glow. Constants: Bruneton and Neyret, "Precomputed Atmospheric Scattering" (2008) and Hillaire, "A Scalable and
/// Production Ready Sky" (2020), table 1; the haze follows the visibility by Koschmieder's relation β = 3.912 / V.
/// Cornette and Shanks' phase function stands for the haze.
///
/// Light is stated as it is by day, and from dusk on as so many times brighter as adaptation.hpp says.
///
/// One unit of radiance is 8000 cd/m², about a clear noon's sky near the horizon; one unit of irradiance is 8000 lx.

#include <array>
#include <vector>

#include <glm/vec3.hpp>

#include "engine/instant/sky_irradiance.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::instant {

/// Unit of radiance in cd/m²; of irradiance in lx, and of intensity in cd, too. A colour's radiance in cd/m² is this
/// times its luminance, 0.2126 r + 0.7152 g + 0.0722 b.
inline constexpr float luminance_unit_cdpm2 = 8000.0f;

/// Sky radiance by direction. Column: √((1 − cos Δ)/2) of the azimuth Δ from the sun; row: ½ + ½·√z (z ≥ 0) or
/// ½ − ½·√−z of the direction's height z, so that rows are dense at the horizon. Below it lies the lit ground.
struct SkyTable {
  static constexpr std::uint32_t columns = 64, rows = 64;
  std::vector<glm::vec3> radiance;  ///< Row by row.
};

struct SkyLight {
  glm::vec3 light_direction{0.0f, 0.0f, 1.0f};  ///< Direction to the sun, or at night to the moon; world frame.
  glm::vec3 light_irradiance{0.0f};             ///< Irradiance of a surface that faces it, clouds included.
  glm::vec3 sun_direction{0.0f, 0.0f, 1.0f};
  glm::vec3 sky_irradiance{0.0f};     ///< Irradiance of a level surface that faces up.
  glm::vec3 ground_irradiance{0.0f};  ///< Irradiance of a level surface that faces down.
  SkyIrradiance irradiance{};         ///< Irradiance of a surface of any direction.
  SkyIrradiance street_irradiance{};  ///< The same of a wall along a street.
  float fog_per_m = 0.0f;             ///< Extinction by haze and fog.
  float fall_per_m = 0.0f;            ///< Extinction by rain or snow, in places where they fall.
  float overcast = 0.0f;              ///< 0 broken clouds to 1 a closed cover.
  /// Light-up of `adaptation`: the factor by which all of this is stated brighter, and by which lamps are to be. At
  /// least 1.
  float light_up = 1.0f;
  float night = 0.0f;         ///< 0 day to 1 night.
  float street_lamps = 0.0f;  ///< Share to which street lamps are lit, 0 to 1.
  float exposure = 1.0f;      ///< Factor from scene radiance to the tone curve's input, in the open.
  SkyTable table;
};

SkyLight sky_light(const Environment& environment);

/// Radiance of the table in a direction (unit, world frame), bilinear.
glm::vec3 sky_radiance(const SkyLight& light, const glm::vec3& direction);

}  // namespace septet::instant
