#pragma once
/// What surfaces of several roughnesses mirror of the sky: its table, seen through microfacets.
///
/// The prefiltered table of Karis, "Real Shading in Unreal Engine 4" (2013): the GGX distribution of facets for a look straight down at the surface, the
/// light weighed with its cosine. Of a mirrored direction a renderer reads one radiance and multiplies it by what the layer reflects. Below the horizon
/// lies the ground, as for irradiance (sky_irradiance.hpp), and not the haze that the sky's table has there: things stand on it and hide that.
/// Made once for a SkyLight, the same bit for bit each time.

#include <array>

#include "engine/instant/atmosphere.hpp"
#include "engine/light/sky_tables.hpp"

namespace septet::instant {

/// One a step of roughness; in each the table's directions, row by row as in SkyTable.
std::array<SkyTable, light::roughness_steps> sky_by_roughness(const SkyLight& light);

}  // namespace septet::instant
