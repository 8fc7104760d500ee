#pragma once
/// What surfaces of several roughnesses mirror of the sky: its table, seen through microfacets.
///
/// The prefiltered table of Karis, "Real Shading in Unreal Engine 4" (2013): the GGX distribution of facets for a look straight down at the surface, the
/// light weighed with its cosine. Of a mirrored direction a renderer reads one radiance and multiplies it by what the layer reflects. Below the horizon
/// lies the ground, as for irradiance (sky_irradiance.hpp), and not the haze that the sky's table has there: things stand on it and hide that.
/// Made once for a SkyLight, the same bit for bit each time.

#include <array>
#include <cstdint>

#include "engine/instant/atmosphere.hpp"

namespace septet::instant {

/// Steps of roughness, from a mirror on; the last is for all that is rougher.
inline constexpr std::uint32_t roughness_steps = 5;
inline constexpr float roughness_step = 0.175f;

/// In each the table's directions, row by row as in SkyTable.
std::array<SkyTable, roughness_steps> sky_by_roughness(const SkyLight& light);

}  // namespace septet::instant
