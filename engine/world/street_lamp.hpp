#pragma once
/// Dimensions and light of a street lamp, for planning streets and for drawing.
///
/// Its light is spread as a street's lens does it, in the form of a bat's wing: the intensity grows by 1/cos³ of the
/// angle from straight down, so that the ground around it is lit evenly up to 55° (11 m from a lamp of 8 m), and fades
/// beyond. Its intensity there is 5.3 times that straight down.

#include <algorithm>
#include <cmath>

namespace septet::street_lamp {

/// The arm reaches from the pole's foot to the lens, towards the road.
inline constexpr double height_m = 8.0, arm_m = 2.5;
inline constexpr float candela = 660.0f;  ///< Straight down: 10.3 lx on the ground below it.

/// Share of the intensity straight down, by the cosine of the angle from there, above 0.
inline float spread(float cosine) {
  constexpr float flattest = 0.5736f, of_flattest = 1.0f / (flattest * flattest * flattest);
  if (cosine >= flattest) return 1.0f / (cosine * cosine * cosine);
  const float share = std::max(cosine, 0.0f) / flattest;
  return of_flattest * share * share;
}

/// Illuminance on level ground, lx, `below_m` under the lens and with `aside_m2` the square of the distance aside, m².
inline double ground_lux(double below_m, double aside_m2) {
  const double square_m2 = below_m * below_m + aside_m2, cosine = below_m / std::sqrt(square_m2);
  return double{candela} * double{spread(static_cast<float>(cosine))} * cosine / square_m2;
}

}  // namespace septet::street_lamp
