#pragma once
/// Exposure of an instant, by the luminance of white: one for all views and all screens of a rig.

#include <cmath>

#include "engine/instant/atmosphere.hpp"

namespace septet::instant {

/// EV at ISO 100. White, where the tone curve's input is 1, is 1.2 · 2^EV100 cd/m² (ISO 12232, saturation-based speed
/// with a lens of transmittance 0.65).
struct Exposure {
  float ev100 = 14.0f;

  /// Factor from radiance, in the unit of atmosphere.hpp, to the tone curve's input (engine/light/tone_curve.hpp).
  float scale() const { return luminance_unit_cdpm2 / (1.2f * std::exp2(ev100)); }
};

/// Exposure with this scale.
inline Exposure exposure_of_scale(float scale) { return {std::log2(luminance_unit_cdpm2 / (1.2f * scale))}; }

}  // namespace septet::instant
