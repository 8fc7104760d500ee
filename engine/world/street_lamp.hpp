#pragma once
/// How a street lamp stands and shines: what streets are planned by, and what is drawn.
///
/// Its light is spread as a street's lens does it, in the form of a bat's wing: so much the stronger the flatter, by 1/cos³ of the angle from straight down, that the
/// ground around it is lit evenly up to 55° (11 m from a lamp of 8 m), and fading beyond. Its intensity there is 5.3 times that straight down.

#include <algorithm>
#include <cmath>

namespace septet::street_lamp {

inline constexpr double height_m = 8.0, arm_m = 2.5;  ///< The lens lies so far towards the road from the pole's foot.
inline constexpr float candela = 660.0f;              ///< Straight down: 10.3 lx on the ground below it.

/// Share of the intensity straight down, by the cosine of the angle from there, above 0.
inline float spread(float cosine) {
  constexpr float flattest = 0.5736f, of_flattest = 1.0f / (flattest * flattest * flattest);
  if (cosine >= flattest) return 1.0f / (cosine * cosine * cosine);
  const float share = std::max(cosine, 0.0f) / flattest;
  return of_flattest * share * share;
}

/// On level ground, lx, so far below the lens and so far aside of it, the square of that in m².
inline double ground_lux(double below_m, double aside_m2) {
  const double square_m2 = below_m * below_m + aside_m2, cosine = below_m / std::sqrt(square_m2);
  return double{candela} * double{spread(static_cast<float>(cosine))} * cosine / square_m2;
}

}  // namespace septet::street_lamp
