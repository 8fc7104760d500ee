#pragma once
/// How an eye adapts to the light of its place, by one curve of the light on level ground: what a display shows by day, at dusk and by night.
///
/// An eye sees all of an office's light (400 lx) and of a lit street's (10 lx), so its gain grows as the light falls: by the power 0.72 above 60,000 lx, where
/// little is wanting, nearly as the light falls down to 50 lx, and from there to that of a lit town's night as far less, so that dusk goes dark. Gain times light
/// never rises as the light falls.
///
/// A display need not show starlight, and what is roofed or shines by itself is given for an exposure that is never more than `most_exposure`. So
/// where the eye's gain is more than that, all light in the open, natural and of lamps, is said as so many times brighter: `light_up`.

namespace septet::instant {

struct Adaptation {
  float exposure = 1.0f;  ///< From radiance, in the unit of atmosphere.hpp, times light_up, to the tone curve's input.
  float light_up =
      1.0f;  ///< Times as bright as all light in the open is shown, 1 by day; headlights and street lamps, too.
  float night = 0.0f;  ///< 0 day to 1 night: how far stars are out and windows lit. Falls with light, as all of these.
  float street_lamps = 0.0f;  ///< How far they are lit, 0 to 1.

  float gain() const { return exposure * light_up; }
};

inline constexpr float most_exposure = 9.0f, most_light_up = 110.0f;

/// To so much light on level ground, lx, of sky and sun or moon.
Adaptation adaptation(double level_lux);

}  // namespace septet::instant
