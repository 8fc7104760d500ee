#pragma once
/// An ambulance's drive through dense traffic on a ring.

#include <algorithm>
#include <cmath>

#include "tests/engine/traffic/ambulance_between_lanes.hpp"
#include "tests/engine/traffic/ring_road.hpp"

namespace septet::traffic {

struct EmergencyRun {
  double ambulance_mps = 0.0, traffic_mps = 0.0;
  int overlaps = 0;
};

/// 40 vehicles/km/lane on five lanes of 5 km; the traffic settles for a minute, then the ambulance
/// drives 5 km.
inline EmergencyRun drive_5_km(std::uint64_t seed) {
  const auto network = ring_road(5000.0, 5);
  const TrafficParameters parameters = motorway_traffic(0, 1e6);
  TrafficState state = dense_ring(network, 5, 1000, seed);
  CorridorTraffic& traffic = state.corridors[0];
  Random random(seed);
  for (int step = 0; step < 600; ++step) advance(parameters, network, {}, 0.1, random, state);
  // On the line between the two fastest lanes, at the largest gap.
  const auto room_at = [&](double x) {
    double least = 1e9;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      if (std::min(traffic.lane[i], traffic.from_lane[i]) > 2) continue;
      const double ahead = distance_m(traffic.corridor, x, traffic.x_m[i]);
      least = std::min(least, ahead > 0.0 ? ahead - traffic.length_m[i] : -ahead - 6.1);
    }
    return least;
  };
  double x = 0.0, most = -1e9;
  for (double at = 0.0; at < 5000.0; at += 1.0) {
    const double room = room_at(at);
    if (room > most) {
      most = room;
      x = at;
    }
  }
  add_emergency_vehicle(traffic, 1, x, 15.0);
  const std::size_t ambulance = traffic.size() - 1;
  EmergencyRun run;
  double way = 0.0, seconds = 0.0, others = 0.0;
  while (way < 5000.0 && seconds < 1000.0) {
    advance(parameters, network, {}, 0.1, random, state);
    way += 0.1 * traffic.speed_mps[ambulance];
    seconds += 0.1;
    double sum = 0.0;
    for (std::size_t i = 0; i < ambulance; ++i) sum += traffic.speed_mps[i];
    others += 0.1 * sum / static_cast<double>(ambulance);
    if (std::fmod(seconds, 0.5) < 0.1) run.overlaps += overlapping_bodies(traffic);
  }
  run.ambulance_mps = way / seconds;
  run.traffic_mps = others / seconds;
  return run;
}

}  // namespace septet::traffic
