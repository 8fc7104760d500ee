#pragma once
/// Intensity of headlights, in the unit of radiance of atmosphere.hpp; for their beam see engine/light/beam.hpp.

#include "engine/instant/atmosphere.hpp"

namespace septet::instant::beam {

/// Intensity of a pair of dipped beams at its peak: 2 · 15,000 cd.
inline constexpr float pair_intensity = 30000.0f / luminance_unit_cdpm2;

}  // namespace septet::instant::beam
