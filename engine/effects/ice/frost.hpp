#pragma once
/// Frost on a windscreen: its distribution in the morning, and its melting under a blower. Pure functions of plain
/// data.
///
/// Places on a pane are shares of it: `across` from its right end (0) to its left one (1), `up` from its foot (0) to
/// its head (1). Masses are of frost per area, kg/m². Glass is thin: it has one temperature T from face to face
/// (lumped), which follows
///     C dT/dt = q,  q = h_b w (T_b − T) + h_a (T_a − T)                        (1)
/// until it comes to freezing under frost; from there on q melts: L dm/dt = q where q > 0, and meltwater runs off. T_a
/// is the air's temperature, T_b that of the air from the blower while the engine warms up,
///     T_b = T_a + ΔT (1 − e^(−t/τ)),                                             (2)
/// h_a is of the car's wind, over a plate whose boundary layer is turbulent from its edge on (Incropera and DeWitt,
/// "Fundamentals of Heat and Mass Transfer", Nu = 0.037 Re^(4/5) Pr^(1/3)), and w the share of the blower's heat
/// transfer at a place: a plane jet along a wall has u ~ y^(−1/2), thus h ~ u^(4/5) y^(−1/5) ~ y^(−3/5) above its vent
/// (Glauert, "The Wall Jet", 1956). ΔT, τ and h_b are assumed; they are compared with the type approval's test of
/// defrosting (Regulation (EU) 672/2010, Annex II: 0.44 kg/m² of ice at −18 °C, 80 % of the driver's field of view
/// clear after 20 minutes).

#include <array>
#include <cstdint>

#include "engine/effects/ice/still_ice.hpp"

namespace septet::ice {

inline constexpr double heated_by_k = 55.0, heating_time_s = 300.0;  ///< ΔT, τ.
inline constexpr double vent_wpm2k = 150.0;                          ///< h_b.
inline constexpr double glass_jpm2k =
    2 * 2.1e-3 * 2500.0 * 840.0 + 1626.0;       ///< C: two panes of 2.1 mm and the film between.
inline constexpr double fusion_jpkg = 333.6e3;  ///< L.
inline constexpr double most_frost_kgpm2 = 0.5;

inline constexpr double least_blower_share = 0.1;  ///< Least w, beyond the jets: air moves everywhere.

/// Knowledge of a pane's warmth: for some shares w of the blower's heat, from the least to 1 and closer where they are
/// small, the temperature of the glass and the mass melted there. Values between them are interpolated.
inline constexpr std::size_t warmth_levels = 16;
struct Frost {
  double thickness_kgpm2 = 0.0;  ///< In the morning, where the driver has not scraped; 0: no frost, or no longer any.
  double heated_s = 0.0;         ///< Running time of the engine.
  std::uint32_t seed = 0;        ///< Seed of its pattern.
  std::array<double, warmth_levels> glass_k{};
  std::array<double, warmth_levels> melted_kgpm2{};
};

/// Frost as the driver gets in: glass as cold as the air, an engine that ran while its windows were scraped. Empty
/// above freezing.
Frost morning_frost(double air_k, std::uint32_t seed);

/// h_a, W/m²K, at a speed.
double wind_wpm2k(double speed_mps);
/// w.
double blower_share(double across, double up);
/// Share of the morning's frost that the driver has left, 0 to 1: a hole was scraped to look through.
double left_by_scraper(double across, double up);

/// Equations 1 and 2 over `step_s`, at most some tenths of a second.
void warm(Frost& frost, double air_k, double speed_mps, double step_s);
/// Mass melted at a place, if there were enough of it.
double melted_kgpm2(const Frost& frost, double across, double up);
/// Present frost at a place.
double frost_kgpm2(const Frost& frost, double across, double up);

}  // namespace septet::ice
