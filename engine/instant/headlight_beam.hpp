#pragma once
/// The dipped beam: the twin of shaders/headlights.glsl.
///
/// A fit to the limits that UN Regulation 149, class B sets for dipped beams, symmetric to both sides: brightest just below the cut-off at 0.57° under
/// the level, a thirtieth of that above it, where it lights signs and the backs of lorries. Shares of the peak at some points, the fit's and (in
/// brackets) a table's that obeys the regulation: 1.7° down 0.72 (0.75), 4° down 0.29 (0.28), 10° down 0.03 (0.05), level 0.03 (0.04), 1° up 0.019
/// (0.015), 4° up 0.009 (0.007); 3.4° to the side 0.83 (0.8), 9° 0.41 (0.33), 20° 0.12 (0.1).

#include <algorithm>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "engine/instant/atmosphere.hpp"

namespace septet::instant::beam {

/// Of a pair of dipped beams at its peak: 2 · 15,000 cd.
inline constexpr float pair_intensity = 30000.0f / luminance_unit_cdpm2;

/// Share of the peak in a direction (unit), for a lamp that points along `level` (unit), both in the world's axes.
inline float share(const glm::vec3& level, const glm::vec3& direction) {
  // Without a branch, so that eight are found at a time.
  const float cosine = glm::dot(direction, level), ahead = std::max(cosine, 1e-6f);
  const float down = level.z * ahead - direction.z;
  const float aside = std::max(0.0f, 1.0f - down * down - ahead * ahead) / (ahead * ahead);
  const float t = std::clamp((down - 0.004f) / 0.010f, 0.0f, 1.0f);
  const float below = t * t * (3.0f - 2.0f * t) / (1.0f + down * down * (400.0f + down * down * 20000.0f));
  const float above = 0.03f / (1.0f + std::max(-down, 0.0f) * 33.0f);
  const float share = std::max(below, above) / (1.0f + aside * 59.0f);
  return cosine > 0.0f ? share : 0.0f;
}

/// Cosine between a surface's normal and the way to the lamp, as it lights rough asphalt: that sends more light back than a matt
/// surface would at so low an angle.
inline float facing(float cosine) { return 0.7f * cosine + 0.3f; }

/// Of what retroreflectors send back, the share that arrives beside the way to the lamp: `away` is 1 − the cosine of the angle between.
inline float returned(float away) { return 1.0f / (1.0f + away * 26000.0f); }

}  // namespace septet::instant::beam
