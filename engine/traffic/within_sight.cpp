#include <algorithm>

#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {

void keep_within_sight(std::span<const LimitedSight> sights, CorridorTraffic& traffic) {
  for (const LimitedSight& sight : sights) {
    const auto found = std::ranges::find(traffic.id, sight.driver);
    if (found == traffic.id.end()) continue;
    const auto i = static_cast<std::size_t>(found - traffic.id.begin());
    traffic.acceleration_mps2[i] =
        std::min(traffic.acceleration_mps2[i],
                 acceleration_within_sight(traffic.driver[i].following, traffic.speed_mps[i], sight.seen_m));
  }
}

}  // namespace septet::traffic
