#pragma once
/// Extinction of light by weather, and how far what is in it can be seen.
///
/// What reflects light is seen until a twentieth of its contrast is left, an optical depth of 3; lamps, and what else shines, up to 8 (Jin,
/// "Visibility through fire smoke"; Koschmieder's range ends at the same twentieth). In the dark a thing that reflects needs light on it: its contrast
/// counts in proportion to the light below `full_light_lx`, so that without air between it ends at 1 lx: 60 m before dipped beams.
///
/// SI units; lux. Pure functions.

#include <algorithm>
#include <cmath>
#include <functional>

#include "engine/math/rigid_transform.hpp"

namespace septet::sight {

/// Optical depth of the air between two places. Empty: it hides nothing.
using OpticalDepth = std::function<double(const Vec3& from_m, const Vec3& to_m)>;

inline constexpr double reflecting_depth = 3.0, shining_depth = 8.0;
/// Optical depth up to which an object is seen.
constexpr double visible_depth(bool shines) { return shines ? shining_depth : reflecting_depth; }

/// Light on a thing from which on it shows its whole contrast: 1 lx over the twentieth that is left at the end.
inline constexpr double full_light_lx = 20.0;

/// True where a thing that reflects is seen through this optical depth, by this light on it.
inline bool sees_reflecting(double depth, double light_lx) {
  return std::exp(-depth) * std::min(1.0, light_lx / full_light_lx) >= std::exp(-reflecting_depth);
}

/// Light on a low thing by a car's own dipped beams, behind air of that optical depth: straight ahead, or to a side.
double dipped_light_lx(double distance_m, double depth, double aside_rad = 0.0);

/// Extinction by haze and fog of this meteorological range (Koschmieder, contrast of 2 %), 1/m.
double fog_extinction_per_m(double visibility_m);

/// Extinction of light by precipitation, 1/m, for a rate R in mm of water an hour. Rain: 0.312 R^0.67 per km (Weber et
/// al. 2015, who sum over Marshall and Palmer's drops). Snow, by the attenuation of optical links (ITU-R P.1814): wet
/// 3.79 R^0.72, below -1 degrees Celsius dry 5.50 R^1.38 dB per km.
double fall_extinction_per_m(double rain_mm_per_h, double temperature_k);

/// Spray behind a vehicle: its optical depth along the middle of the cloud, and the time in which it thins to 1/e.
struct Wake {
  double depth = 0.0, thins_s = 1.0;
};
/// Depth: zero below 8 m/s, then with the square of the speed, and with the water on the road. That of a lorry at 25 m/s in standing water takes
/// 70 % of the light (measured losses run from 20 to 70 %); that of a car takes a quarter.
Wake spray_wake(bool heavy, double speed_mps, double road_wetness);

/// Speed from which one who brakes so after that time stops within a distance.
inline double stopping_speed_mps(double distance_m, double reaction_s, double braking_mps2) {
  const double reacts_mps = braking_mps2 * reaction_s;
  return std::sqrt(reacts_mps * reacts_mps + 2.0 * braking_mps2 * std::max(0.0, distance_m)) - reacts_mps;
}

}  // namespace septet::sight
