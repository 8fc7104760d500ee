#include "engine/effects/ice/frost.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace septet::ice {
namespace {

constexpr double blower_air_k(double air_k, double risen) { return air_k + heated_by_k * risen; }

constexpr auto last_level = static_cast<double>(warmth_levels - 1);

/// Closer to each other where they are small, as most of a pane has small ones.
constexpr double share_of(std::size_t level) {
  const double root = static_cast<double>(level) / last_level;
  return least_blower_share + (1.0 - least_blower_share) * root * root;
}

}  // namespace

Frost morning_frost(double air_k, std::uint32_t seed) {
  constexpr double per_k = 0.03, most = 0.25, scraping_s = 180.0;  // Assumed.
  Frost frost;
  if (!(air_k < freezing_k)) return frost;
  frost.thickness_kgpm2 = std::min(most, per_k * (freezing_k - air_k));
  frost.heated_s = scraping_s;
  frost.seed = seed;
  frost.glass_k.fill(air_k);
  return frost;
}

double wind_wpm2k(double speed_mps) {
  // Air at 0 °C; the pane's length along the wind. A standing car has some wind, too.
  constexpr double viscosity_m2ps = 1.33e-5, conductivity_wpmk = 0.0243, prandtl = 0.715, length_m = 0.8, still = 8.0;
  const double reynolds = std::abs(speed_mps) * length_m / viscosity_m2ps;
  return std::max(still, 0.037 * std::pow(reynolds, 0.8) * std::cbrt(prandtl) * conductivity_wpmk / length_m);
}

double blower_share(double across, double up) {
  // A slot before each seat; its jet widens upwards.
  constexpr double slot = 0.07, length_in_slots = 1.0 / 0.07, half_width = 0.17, widens = 0.16;
  const double above = std::pow(1.0 + std::max(up, 0.0) * length_in_slots, -0.6),
               width = half_width + widens * up + slot;
  double most = 0.0;
  for (const double vent : {0.26, 0.74}) most = std::max(most, std::exp(-std::pow((across - vent) / width, 2.0)));
  return std::clamp(above * most, least_blower_share, 1.0);
}

double left_by_scraper(double across, double up) {
  // Strokes of a blade, side by side along an arc about the driver's shoulder: some are longer than others, with gaps
  // between some.
  constexpr double middle = 0.735, reach = 0.15, low = 0.24, high = 0.76, strokes = 7.0;
  const double lean = (across - middle) / reach + 0.22 * (up - 0.45), stroke = (lean + 1.0) * 0.5 * strokes;
  const double nth = std::floor(stroke), off = stroke - nth - 0.5;
  const double uneven = 0.05 * std::sin(2.7 * nth + 0.6) + 0.04 * std::sin(5.1 * nth);
  const double arched = (high - low) * 0.5 * std::sqrt(std::max(0.0, 1.0 - 0.75 * lean * lean)),
               centre = 0.5 * (low + high);
  const double inside = std::min(1.0 - std::abs(lean), (arched + uneven - std::abs(up - centre)) * 3.0);
  const auto smooth = [](double x) {
    x = std::clamp(x, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
  };
  const double scraped = smooth(inside * 7.0 + 0.2), ridge = smooth((std::abs(off) - 0.40) * 10.0);
  return 1.0 - scraped * (0.97 - 0.30 * ridge);
}

void warm(Frost& frost, double air_k, double speed_mps, double step_s) {
  if (!(frost.thickness_kgpm2 > 0.0) || !(step_s > 0.0)) return;
  frost.heated_s += step_s;
  const double blown_k = blower_air_k(air_k, 1.0 - std::exp(-frost.heated_s / heating_time_s)),
               wind = wind_wpm2k(speed_mps);
  bool left = false;
  for (std::size_t i = 0; i < warmth_levels; ++i) {
    double& glass_k = frost.glass_k[i];
    double& melted = frost.melted_kgpm2[i];
    const bool covered = melted < frost.thickness_kgpm2;
    const double q = vent_wpm2k * share_of(i) * (blown_k - glass_k) + wind * (air_k - glass_k);
    double next_k = glass_k + q * step_s / glass_jpm2k;
    if (covered && next_k > freezing_k) {
      const double above_jpm2 = (next_k - freezing_k) * glass_jpm2k,
                   taken_jpm2 = std::min(above_jpm2, (frost.thickness_kgpm2 - melted) * fusion_jpkg);
      melted = taken_jpm2 < above_jpm2 ? frost.thickness_kgpm2 : melted + taken_jpm2 / fusion_jpkg;
      next_k = freezing_k + (above_jpm2 - taken_jpm2) / glass_jpm2k;
    }
    glass_k = next_k;
    left = left || melted < frost.thickness_kgpm2;
  }
  if (!left) frost = {};
}

double melted_kgpm2(const Frost& frost, double across, double up) {
  const double above = (blower_share(across, up) - least_blower_share) / (1.0 - least_blower_share),
               at = std::sqrt(above) * last_level;
  const auto low = std::min(static_cast<std::size_t>(at), warmth_levels - 2);
  return std::lerp(frost.melted_kgpm2[low], frost.melted_kgpm2[low + 1], at - static_cast<double>(low));
}

double frost_kgpm2(const Frost& frost, double across, double up) {
  return std::max(0.0, frost.thickness_kgpm2 * left_by_scraper(across, up) - melted_kgpm2(frost, across, up));
}

}  // namespace septet::ice
