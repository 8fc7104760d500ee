#pragma once
/// Adaptation of an eye to the light of its place, by one curve of the illuminance of level ground: how a display shows
/// day, dusk and night.
///
/// An eye sees well in an office's light (400 lx) and in a lit street's (10 lx), so its gain grows as the light falls:
/// by the power 0.72 above 60,000 lx, nearly in proportion (the power 0.88) down to 50 lx, and from there to the light
/// of a lit town's night much less, so that dusk goes dark. Gain times light never rises as the light falls.
///
/// A display need not show starlight, and roofed places and sources of light are described for an exposure that never
/// exceeds `most_exposure`. If the eye's gain is greater than that, all light in the open, natural and of lamps, is
/// stated as so many times brighter: `light_up`.

namespace septet::instant {

struct Adaptation {
  /// Factor from radiance, in the unit of atmosphere.hpp, times light_up, to the tone curve's input.
  float exposure = 1.0f;
  /// Factor by which all light in the open is shown brighter, 1 by day; headlights and street lamps, too.
  float light_up = 1.0f;
  /// 0 day to 1 night: visibility of stars, lighting of windows. Falls with light, as do all of these.
  float night = 0.0f;
  float street_lamps = 0.0f;  ///< Share to which street lamps are lit, 0 to 1.

  float gain() const { return exposure * light_up; }
};

inline constexpr float most_exposure = 9.0f, most_light_up = 110.0f;

/// Adaptation to an illuminance of level ground, lx, by sky and sun or moon.
Adaptation adaptation(double level_lux);

}  // namespace septet::instant
