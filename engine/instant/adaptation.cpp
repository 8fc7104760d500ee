#include "engine/instant/adaptation.hpp"

#include <algorithm>
#include <cmath>

namespace septet::instant {
namespace {

constexpr double day_lux = 60e3, dusk_lux = 50.0, night_lux = 1.2;
constexpr double gain_by_day = 0.58, power_by_day = 0.72, power_at_dusk = 0.88, least_gain = 0.1;

double gain_of(double lux) {
  if (lux >= day_lux) return std::max(least_gain, gain_by_day * std::pow(day_lux / lux, power_by_day));
  const double at_dusk = gain_by_day * std::pow(day_lux / std::max(lux, dusk_lux), power_at_dusk);
  if (lux >= dusk_lux) return at_dusk;
  const double by_night = double{most_exposure} * most_light_up;
  const double share = std::log(dusk_lux / std::max(lux, night_lux)) / std::log(dusk_lux / night_lux);
  return at_dusk * std::pow(by_night / at_dusk, share);
}

/// Smooth step: 0 at `from` and above, 1 at `to` and below.
double step_down(double from, double to, double lux) {
  const double t = std::clamp(std::log(from / std::max(lux, to)) / std::log(from / to), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

}  // namespace

Adaptation adaptation(double level_lux) {
  const double lux = std::max(level_lux, 1e-6), gain = gain_of(lux);
  const double light_up = std::clamp(gain / most_exposure, 1.0, double{most_light_up});
  return {static_cast<float>(gain / light_up), static_cast<float>(light_up),
          static_cast<float>(step_down(400.0, 2.0, lux)), static_cast<float>(step_down(400.0, 100.0, lux))};
}

}  // namespace septet::instant
