#pragma once
/// Measurements on rings.

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/traffic/ring.hpp"

namespace septet::traffic {

inline ModelIndex model_named(std::string_view name) { return *find_vehicle_model(name); }

/// Pairs of vehicles whose bodies overlap, counting the lateral place with the corridor's nominal
/// lane width.
inline int overlapping_bodies(const CorridorTraffic& traffic) {
  int count = 0;
  std::vector<std::size_t> by_x;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] > 0) by_x.push_back(i);
  }
  std::sort(by_x.begin(), by_x.end(), [&](std::size_t a, std::size_t b) { return traffic.x_m[a] < traffic.x_m[b]; });
  const std::size_t n = by_x.size();
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t behind = by_x[k];
    for (std::size_t step = 1; step < n; ++step) {
      const std::size_t ahead = by_x[(k + step) % n];
      double d = traffic.x_m[ahead] - traffic.x_m[behind];
      if (d < 0.0) d += traffic.corridor.closed ? traffic.corridor.length_m : 1e9;
      if (d > 20.0) break;
      const double apart = std::abs(lateral_m(traffic, ahead) - lateral_m(traffic, behind));
      const bool beside = apart >= traffic.half_width_m[ahead] + traffic.half_width_m[behind];
      if (d < traffic.length_m[ahead] && !beside) ++count;
    }
  }
  return count;
}

}  // namespace septet::traffic
