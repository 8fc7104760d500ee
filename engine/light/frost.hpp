#ifndef SEPTET_LIGHT_FROST_HPP
#define SEPTET_LIGHT_FROST_HPP
/// Frost on glass: feathers of ice, and how much of what lies behind they hide.
///
/// Crystals hide by Beer and Lambert what lies behind them, with the area that grains of 0.1 mm have by their mass, 3/(2 ρ r). Feathers, each a stem
/// with barbs at 60° to it, grew until they met; where they are, the mass lies, 0.79 of it on average. Places are metres on the pane.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Share of the light on either side of frost that leaves by both sides alike: multiply scattered, little is lost.
LIGHT_CONST float frost_albedo = 0.88f;

LIGHT_CONST float frost_m2pkg = 16.0f;
/// So little hides less than a code.
LIGHT_CONST float least_frost_kgpm2 = 5e-5f;
/// Tiles of the noise in a metre of the pane.
LIGHT_CONST float frost_noise_per_m = 7.0f;
/// Mean of feather_mass.
LIGHT_CONST float mean_feather_mass = 0.79f;

/// Two numbers from 0 to 1 for a cell of a grid: a hash.
LIGHT_FN vec2 random_place(vec2 cell) {
  const uint across = uint(int(cell.x) + 4096) * 1597334677u, along = uint(int(cell.y) + 4096) * 3812015801u;
  const uint hash = (across ^ along) * 1597334677u;
  return vec2(float(hash >> 16), float((hash * 747796405u) >> 16)) / 65536.0f;
}

/// The feather that a place lies in: along its stem and aside of it, m, and how far the next feather is beyond it.
struct FeatherPlace {
  float along;
  float aside;
  float seam;
};

/// The feather of one of the four cells around a place reaches it, or nearly.
LIGHT_FN FeatherPlace feather_at(vec2 place) {
  const float cell_m = 0.034f;
  const vec2 cell = floor(place / cell_m - 0.5f);
  float nearest = 1e9f, second = 1e9f;
  vec2 feather = vec2(0.0f);
  for (int k = 0; k < 4; ++k) {
    const vec2 at = cell + vec2(float(k & 1), float(k >> 1)), germ = random_place(at);
    const vec2 off = place - (at + 0.15f + 0.7f * germ) * cell_m;
    const vec2 way = normalize(fract(germ * 37.0f) - 0.5f + 1e-4f);
    const vec2 own = vec2(dot(off, way), dot(off, vec2(-way.y, way.x)));
    const float far = abs(own.x) * 0.55f + abs(own.y);
    second = min(second, max(far, nearest));
    feather = far < nearest ? own : feather;
    nearest = min(nearest, far);
  }
  FeatherPlace result;
  result.aside = abs(feather.y);
  result.along = feather.x - 0.577f * result.aside;
  result.seam = second - nearest;
  return result;
}

/// Relative mass of the frost at a place. `grain`: the noise there, 0 to 1. `fine`, `coarse`: how much is seen of what is some millimetres
/// wide and of what is some centimetres wide, 1 beside the pane; what is not seen counts by its mean.
LIGHT_FN float feather_mass(FeatherPlace feather, float grain, float fine, float coarse) {
  const float wander = 6.0f * grain;
  const float barbs = 0.5f + 0.5f * cos(feather.along * (2.0f * pi / 0.0034f) + wander);
  const float twigs =
      0.5f + 0.5f * cos((feather.aside * 1.155f + 0.5f * feather.along) * (2.0f * pi / 0.0013f) + 2.0f * wander);
  const float stem = exp(-feather.aside * feather.aside / (0.0007f * 0.0007f));
  const float seam = smoothstep(0.0f, 0.004f, feather.seam);
  const float lies = 0.84f +
                     fine * (1.1f * (barbs * barbs * barbs - 0.3125f) * (0.7f + 0.6f * twigs) + 0.8f * stem - 0.044f) +
                     coarse * (grain - 0.496f);
  return max(lies * mix(0.94f, 0.55f + 0.45f * seam, coarse), 0.0f);
}

/// Share of what lies behind that is hidden by so much frost.
LIGHT_FN float frost_hides(float mass, float frost_kgpm2) { return 1.0f - exp(-frost_m2pkg * frost_kgpm2 * mass); }

/// The same where the mass varies within what is looked at, as a gamma distribution: `variance` over its mean.
LIGHT_FN float frost_hides_on_average(float mass, float variance, float frost_kgpm2) {
  return 1.0f - pow(1.0f + variance * frost_m2pkg * frost_kgpm2, -mass / variance);
}

LIGHT_END

#endif
