#pragma once
/// Sky as reflected by surfaces of several roughnesses: its table, seen through microfacets.
///
/// Prefiltered table of Karis, "Real Shading in Unreal Engine 4" (2013): the GGX distribution of facets for a look
/// straight down at the surface, the light weighed with its cosine. A renderer reads one radiance in the mirrored
/// direction and multiplies it by the layer's reflectance. Below the horizon lies the ground, as for irradiance
/// (sky_irradiance.hpp), and not the haze of the sky's table, since objects on the ground hide that. Made once for a
/// SkyLight, the same bit for bit each time.

#include <array>

#include "engine/instant/atmosphere.hpp"
#include "engine/light/sky_tables.hpp"

namespace septet::instant {

/// Tables by step of roughness; in each the directions, row by row as in SkyTable.
std::array<SkyTable, light::roughness_steps> sky_by_roughness(const SkyLight& light);

}  // namespace septet::instant
