#ifndef SEPTET_LIGHT_BEAM_HPP
#define SEPTET_LIGHT_BEAM_HPP
/// The beams of a pair of headlights, dipped and main.
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
///
/// Directions are unit vectors along the world's axes. Without branches, so that a compiler works out eight at a time; fractions are made one, as
/// divisions cost most.

#include "engine/light/language.hpp"

LIGHT_BEGIN

/// Main beam's peak as a multiple of the dipped one's: 60,000 cd to 15,000.
LIGHT_CONST float main_beam_peak = 4.0f;

/// Colour of halogen lamps, where 1 is white.
LIGHT_CONST vec3 headlight_color = vec3(1.0f, 0.93f, 0.80f);

/// A direction as seen from a lamp: the cosine with where it points, that and its square where it is ahead, how far below and (squared) aside.
struct BeamWay {
  float cosine;
  float ahead2;
  float down;
  float down2;
  float aside2;
};

LIGHT_FN BeamWay beam_way(vec3 level, vec3 direction) {
  BeamWay way;
  way.cosine = dot(direction, level);
  const float ahead = max(way.cosine, 1e-6f);
  way.ahead2 = ahead * ahead;
  way.down = level.z * ahead - direction.z;
  way.down2 = way.down * way.down;
  way.aside2 = max(0.0f, 1.0f - way.down2 - way.ahead2);
  return way;
}

/// Fall-off of the dipped beam below its cut-off.
LIGHT_FN float dipped_falls(BeamWay way) { return 1.0f + way.down2 * (400.0f + way.down2 * 20000.0f); }

/// The dipped beam's share is dipped_over(…)/dipped_under(…), times ahead².
LIGHT_FN float dipped_over(BeamWay way) {
  return max(smoothstep(0.004f, 0.0125f, way.down), 0.03f * dipped_falls(way));
}

LIGHT_FN float dipped_under(BeamWay way) {
  return dipped_falls(way) * (1.0f + max(-way.down, 0.0f) * 33.0f) * (way.ahead2 + way.aside2 * 59.0f);
}

/// The main beam's is main_beam_peak/main_under(…), times ahead².
LIGHT_FN float main_under(BeamWay way) {
  return way.ahead2 + way.aside2 * 500.0f + way.ahead2 * way.down2 * (900.0f + way.down2 * 1e6f);
}

/// Share of the dipped beam's peak in a direction, for a lamp that points along `level`; over `times`.
LIGHT_FN float dipped_share(vec3 level, vec3 direction, float times) {
  const BeamWay way = beam_way(level, direction);
  const float share = way.ahead2 * dipped_over(way) / (dipped_under(way) * times);
  return way.cosine > 0.0f ? share : 0.0f;
}

/// The same with the main beam beside it; `main_beam`: how far that is lit, 0 to 1.
LIGHT_FN float beam_share(vec3 level, vec3 direction, float main_beam, float times) {
  const BeamWay way = beam_way(level, direction);
  const float under = dipped_under(way), under_main = main_under(way);
  const float over = dipped_over(way) * under_main + main_beam * main_beam_peak * under;
  const float share = way.ahead2 * over / (under * under_main * times);
  return way.cosine > 0.0f ? share : 0.0f;
}

/// Cosine between a surface's normal and the way to the lamp, as it lights rough asphalt: that sends more light back than a matt
/// surface would at so low an angle.
LIGHT_FN float beam_facing(float cosine) { return 0.7f * cosine + 0.3f; }

/// What a lamp's light is divided by at a distance of which this is the square, m²: near the lamp, where it is no point, the light does not grow
/// without limit.
LIGHT_FN float lamp_spread_m2(float square_m2) { return square_m2 + 1.0f; }

/// Share of retroreflected light that arrives beside the way to the lamp: `away` is 1 − the cosine of the angle between.
LIGHT_FN float beam_returned(float away) { return 1.0f / (1.0f + away * 26000.0f); }

LIGHT_END

#endif
