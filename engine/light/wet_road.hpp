#ifndef SEPTET_LIGHT_WET_ROAD_HPP
#define SEPTET_LIGHT_WET_ROAD_HPP
/// Water on a road: how much of it lies where, and what that makes of the road's colour and gloss.
///
/// Puddles stand still: hollows of the asphalt are a sheet of noise over the world that repeats after `puddle_tile_m`, deeper where wheels have worn
/// ruts. From half wetness on, water fills the deepest; at full wetness a quarter of the road lies under it. The film between
/// covers a share of the road that grows with wetness, and its facets are as rough as the stones below it.
///
/// `wet`: wetness of a place, 0 to 1. `under_water`: the share of it that lies in a puddle.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Side of the tile of puddles, and of that of the rings of rain, m.
LIGHT_CONST float puddle_tile_m = 48.0f;
LIGHT_CONST float ripple_tile_m = 1.0f;

/// Share of a wet road that mirrors between its puddles, and in them.
LIGHT_CONST float film_share = 0.36f;
LIGHT_CONST float puddle_mirrors = 0.95f;
LIGHT_CONST float film_roughness = 0.12f;
LIGHT_CONST float puddle_roughness = 0.03f;

/// Reflectance of water, straight on.
LIGHT_CONST float water_reflectance = 0.02f;

/// Share of a road of that wetness that lies under water.
LIGHT_FN float puddle_share(float wetness) { return 0.25f * clamp(2.0f * wetness - 1.0f, 0.0f, 1.0f); }

/// Share of a place under water, 0 to 1. `rank`: of the noise there, 0 to 1. `rut`: 1 where wheels run. `share`: puddle_share of its wetness.
LIGHT_FN float puddle_at(float rank, float rut, float share) {
  return smoothstep(1.0f - share, 1.05f - share, rank + 0.12f * rut) * step(1e-6f, share);
}

/// A wet surface is darker: what it sends back meets its water's face from within.
LIGHT_FN vec3 wet_albedo(vec3 albedo, float wet, float under_water) {
  return albedo * ((1.0f - 0.55f * wet) * (1.0f - 0.3f * under_water));
}

/// Share of a place that mirrors.
LIGHT_FN float water_covers(float wet, float under_water) { return mix(film_share * wet, puddle_mirrors, under_water); }

LIGHT_FN float water_roughness(float under_water) { return mix(film_roughness, puddle_roughness, under_water); }

/// Remaining share of the light from the beads of a stripe: water over them mirrors the light away.
LIGHT_FN float wet_beads_return(float wet) { return 1.0f - 0.8f * wet; }

LIGHT_END

#endif
