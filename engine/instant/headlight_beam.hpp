#pragma once
/// The beams of a pair of headlights, dipped and main: the twin of shaders/headlights.glsl.
///
/// The dipped beam is a fit to the limits that UN Regulation 149, class B sets for it, symmetric to both sides: brightest just below the cut-off at
/// 0.57° under the level, a thirtieth of that above it, where it lights signs and the backs of lorries. Shares of the peak at some points, the fit's and (in
/// brackets) a table's that obeys the regulation: 1.7° down 0.72 (0.75), 4° down 0.29 (0.28), 10° down 0.03 (0.05), level 0.03 (0.04), 1° up 0.019
/// (0.015), 4° up 0.009 (0.007); 3.4° to the side 0.83 (0.8), 9° 0.41 (0.33), 20° 0.12 (0.1).
///
/// The main beam is lit beside the dipped one. It is symmetric, brightest straight ahead, 60,000 cd a lamp, and falls off so that on the level it gives
/// what UN Regulation 149, 5.1.3 (tables 5 and 6, class B) asks at least, here in brackets: ahead 60,000 cd (40,500, and 0.8 of the brightest),
/// 3° to the side 25,000 (17,500), 6° 9,200 (5,000), 9° 4,400 (3,400), 12° 2,500 (1,500). Up and down, where the tables ask nothing,
/// it is narrower: at 1.5° 0.48 of the peak, at 4° 0.03.

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/instant/atmosphere.hpp"

namespace septet::instant::beam {

/// Of a pair of dipped beams at its peak: 2 · 15,000 cd.
inline constexpr float pair_intensity = 30000.0f / luminance_unit_cdpm2;

/// Main beam's peak as a multiple of the dipped one's: 60,000 cd to 15,000.
inline constexpr float main_peak = 4.0f;

/// Share of the dipped beam's peak in a direction (unit), for a lamp that points along `level` (unit), both in the world's axes. `main_beam`: how
/// far that is lit beside it, 0 to 1.
inline float share(const glm::vec3& level, const glm::vec3& direction, float main_beam = 0.0f) {
  // Without a branch, so that eight are found at a time.
  const float cosine = glm::dot(direction, level), ahead = std::max(cosine, 1e-6f);
  const float down = level.z * ahead - direction.z, down2 = down * down, ahead2 = ahead * ahead;
  const float aside = std::max(0.0f, 1.0f - down2 - ahead2), falls = 1.0f + down2 * (400.0f + down2 * 20000.0f);
  const float t = std::clamp((down - 0.004f) / 0.0085f, 0.0f, 1.0f);
  // All fractions are one, as divisions cost most.
  const float dipped = std::max(t * t * (3.0f - 2.0f * t), 0.03f * falls);
  const float over = falls * (1.0f + std::max(-down, 0.0f) * 33.0f) * (ahead2 + aside * 59.0f);
  const float over_main = ahead2 + aside * 500.0f + ahead2 * down2 * (900.0f + down2 * 1e6f);
  const float share = ahead2 * (dipped * over_main + main_beam * main_peak * over) / (over * over_main);
  return cosine > 0.0f ? share : 0.0f;
}

/// Cosine between a surface's normal and the way to the lamp, as it lights rough asphalt: that sends more light back than a matt
/// surface would at so low an angle.
inline float facing(float cosine) { return 0.7f * cosine + 0.3f; }

/// Of what retroreflectors send back, the share that arrives beside the way to the lamp: `away` is 1 − the cosine of the angle between.
inline float returned(float away) { return 1.0f / (1.0f + away * 26000.0f); }

}  // namespace septet::instant::beam
