#pragma once
/// Transition from one level of detail to the next: not in one frame, but pixel by pixel over a band of distances
/// around the border of their ranges.
///
/// Every pixel (of the ray tracer, every ray) has a threshold in [0, 1), and a level is drawn if that lies within its
/// fade. Levels with a common border divide the thresholds between them: each pixel shows just one of them, and the
/// shares depend on the eye's distance alone, so that all screens show the same.

#include <algorithm>
#include <cmath>

namespace septet::instant {

/// Range of thresholds: a level is drawn where from ≤ threshold < to.
struct LevelFade {
  float from = 0.0f, to = 1.0f;

  bool all() const { return from <= 0.0f && to >= 1.0f; }
  bool none() const { return from >= to; }
  bool shows(float threshold) const { return threshold >= from && threshold < to; }
  float share() const { return std::max(0.0f, to - from); }
  bool operator==(const LevelFade&) const = default;
};

/// Half the width of the band, as a share of the distance in its middle and at most in metres; a tree at 100 m changes
/// between 88 and 112 m. At greater distances no more metres are needed, since they pass no faster, and fading meshes
/// are drawn twice.
inline constexpr float fade_half_band = 0.12f, most_fade_half_band_m = 12.0f;
inline float fade_half_band_m(float border_m) { return std::min(fade_half_band * border_m, most_fade_half_band_m); }
/// Number of steps of a fade, so that neighbours fade together and take one draw.
inline constexpr float fade_steps = 64.0f;

/// Distance from which a level visible until `visible_to_m` is not drawn at all.
inline float gone_from_m(float visible_to_m) { return visible_to_m + fade_half_band_m(visible_to_m); }

/// Fade of a level that is visible while the eye's distance is in [visible_from_m, visible_to_m).
inline LevelFade fade_at(float range_m, float visible_from_m, float visible_to_m) {
  // Share of the nearer level at a border at `border_m`.
  const auto nearer = [&](float border_m) {
    if (!(range_m < gone_from_m(border_m))) return 0.0f;  // Returns 0 for NaN, too.
    const float at = 0.5f * (range_m - border_m) / fade_half_band_m(border_m) + 0.5f;
    return 1.0f - std::round(std::clamp(at, 0.0f, 1.0f) * fade_steps) / fade_steps;
  };
  return {nearer(visible_from_m), nearer(visible_to_m)};
}

}  // namespace septet::instant
