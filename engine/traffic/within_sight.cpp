#include <algorithm>
#include <cmath>

#include "engine/sight/air.hpp"
#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

void keep_within_sight(std::span<const LimitedSight> sights, CorridorTraffic& traffic) {
  constexpr double reaction_s = 1.0, settles_s = 1.0;
  for (const LimitedSight& sight : sights) {
    const auto found = std::ranges::find(traffic.id, sight.driver);
    if (found == traffic.id.end()) continue;
    const auto i = static_cast<std::size_t>(found - traffic.id.begin());
    const FollowingParameters& driver = traffic.driver[i].following;
    const double braking_mps2 = driver.comfortable_braking_mps2;
    const double most_mps = sight::stopping_speed_mps(sight.seen_m - driver.standstill_gap_m, reaction_s, braking_mps2);
    const double mps2 = std::max(-2.0 * braking_mps2, (most_mps - traffic.speed_mps[i]) / settles_s);
    traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], mps2);
  }
}

}  // namespace septet::traffic
