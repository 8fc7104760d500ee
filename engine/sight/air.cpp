#include "engine/sight/air.hpp"

#include "engine/light/beam.hpp"

namespace septet::sight {

double dipped_light_lx(double distance_m, double depth, double aside_rad) {
  constexpr double pair_cd = 30000.0, lamp_up_m = 0.65, thing_up_m = 0.3;
  const double away_m = std::max(distance_m, 1.0);
  const light::vec3 way =
      light::normalize(light::vec3(static_cast<float>(away_m * std::cos(aside_rad)),
                                   static_cast<float>(away_m * std::sin(aside_rad)), thing_up_m - lamp_up_m));
  return pair_cd * light::dipped_share({1.0f, 0.0f, 0.0f}, way, 1.0f) * std::exp(-depth) / (away_m * away_m);
}

double fog_extinction_per_m(double visibility_m) { return 3.912 / std::clamp(visibility_m, 10.0, 200.0e3); }

double fall_extinction_per_m(double rain_mm_per_h, double temperature_k) {
  constexpr double snow_below_k = 274.65, dry_below_k = 272.15, per_decibel = 0.23026, per_km = 1e-3;
  if (!(rain_mm_per_h > 0.0)) return 0.0;
  const double rate = std::min(rain_mm_per_h, 300.0);
  if (temperature_k >= snow_below_k) return per_km * 0.312 * std::pow(rate, 0.67);
  const bool dry = temperature_k < dry_below_k;
  return per_km * per_decibel * (dry ? 5.50 * std::pow(rate, 1.38) : 3.79 * std::pow(rate, 0.72));
}

Wake spray_wake(bool heavy, double speed_mps, double road_wetness) {
  constexpr double onset_mps = 8.0, full_mps = 25.0, most_mps = 70.0;
  const Wake full = heavy ? Wake{1.2, 1.2} : Wake{0.29, 0.5};
  if (!(speed_mps > onset_mps) || !(speed_mps < most_mps) || !(road_wetness > 0.0)) return {0.0, full.thins_s};
  const double speed = (speed_mps * speed_mps - onset_mps * onset_mps) / (full_mps * full_mps - onset_mps * onset_mps);
  const double water = std::clamp((road_wetness - 0.15) / 0.85, 0.0, 1.0);
  return {full.depth * std::min(speed, 1.6) * water, full.thins_s};
}

}  // namespace septet::sight
