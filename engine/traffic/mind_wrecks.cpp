/// Room to turn out before wrecks, and for those who turn out.

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/traffic/wrecks.hpp"

namespace septet::traffic {
namespace {

constexpr double waits_mps = 6.0, waits_within_m = 30.0;

/// Brakes no harder than people do who see it coming.
void brake(CorridorTraffic& traffic, std::size_t i, double acceleration_mps2) {
  const double bounded_mps2 = std::max(acceleration_mps2, -hardest_stop_mps2(traffic, i));
  traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], bounded_mps2);
}

/// Brakes to come to rest this far ahead, less the gap that it leaves.
void brake_to(CorridorTraffic& traffic, std::size_t i, double to_stop_m) {
  constexpr LaneEntry stop{};
  if (to_stop_m > 0.0) brake(traffic, i, acceleration_behind(traffic.law[i], traffic.speed_mps[i], &stop, to_stop_m));
}

/// A change that has begun takes less way the slower the vehicle is: it goes so slowly that the change is over before a
/// body in either of its lanes, and leaves room for the next change, or before the next one in the lane that it leaves.
void finish_before(CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i) {
  constexpr double response_s = 0.5, slowest_mps = 1.0;
  const double stands_m = traffic.law[i].standstill_gap_m;
  const int from = traffic.from_lane[i];
  const double left_s = (1.0 - traffic.change_part[i]) * traffic.driver[i].lane_change.duration_s;
  const Detour next = detour_round(traffic, wrecks, i, traffic.lane[i]);
  const double next_room_m =
      next.gap_m == no_leader ? 0.0 : room_to_turn_out_m(traffic, i, next.lanes, Turning::at_ease) + spare_m - stands_m;
  const double closed_m = std::min(next.gap_m - next_room_m, closed_ahead_m(traffic, wrecks, i, from));
  if (closed_m == no_leader) return;
  double most_mps = (closed_m - stands_m) / left_s;
  std::uint32_t hint = 0;
  const LaneEntry* ahead = neighbours(traffic, from, traffic.x_m[i], static_cast<std::int32_t>(i), hint).ahead;
  if (ahead != nullptr && ahead->vehicle >= 0 && traffic.lane[static_cast<std::size_t>(ahead->vehicle)] == from)
    most_mps =
        std::min(most_mps, ahead->speed_mps + (gap_to(traffic, from, traffic.x_m[i], ahead) - stands_m) / left_s);
  const double over_mps = traffic.speed_mps[i] - std::max(most_mps, slowest_mps);
  if (over_mps > 0.0) brake(traffic, i, -over_mps / response_s);
}

/// Keeps room to turn out at ease, or else, where that is behind it, as tight as it can.
void keep_room(CorridorTraffic& traffic, std::size_t i, const Detour& detour, double at_ease_m) {
  const double v = traffic.speed_mps[i], way_to_stop_m = v * v / (2.0 * hardest_stop_mps2(traffic, i));
  const auto to_stop_m = [&](double room_m) {
    return detour.gap_m - room_m - spare_m + traffic.law[i].standstill_gap_m;
  };
  const bool is_ahead = to_stop_m(at_ease_m) > way_to_stop_m;
  brake_to(traffic, i, to_stop_m(is_ahead ? at_ease_m : room_to_turn_out_m(traffic, i, detour.lanes, Turning::tight)));
}

/// Nobody of its lane is between it and the body but one who leaves the lane.
bool is_first_in_lane(const CorridorTraffic& traffic, std::size_t i, double gap_m) {
  const int lane = traffic.lane[i];
  return std::ranges::none_of(traffic.order.lanes[static_cast<std::size_t>(lane)], [&](const LaneEntry& entry) {
    if (entry.vehicle < 0 || entry.vehicle == static_cast<std::int32_t>(i)) return false;
    const double there_m = distance_m(traffic.corridor, traffic.x_m[i], entry.x_m);
    return there_m > 0.0 && there_m < gap_m + 1.0 && traffic.lane[static_cast<std::size_t>(entry.vehicle)] == lane;
  });
}

/// The next one behind it in the lane that it is to change to leaves it a gap, if mild braking is enough for that.
void let_in(CorridorTraffic& traffic, std::size_t i, int lane) {
  std::uint32_t hint = 0;
  const double rear_x_m = traffic.x_m[i] - traffic.length_m[i];
  const LaneEntry* behind = neighbours(traffic, lane, rear_x_m, static_cast<std::int32_t>(i), hint).behind;
  if (behind == nullptr || behind->vehicle < 0) return;
  const auto k = static_cast<std::size_t>(behind->vehicle);
  if (traffic.lane[k] != lane || traffic.emergency[k] != 0) return;
  // So much that the change is safe (lane_change.cpp), and not only just.
  constexpr double more_m = 2.5, least_gap_m = 0.5;
  const LaneEntry own = entry_of(traffic, i);
  const double gap_m = gap_to(traffic, lane, behind->x_m, &own) - more_m;
  if (gap_m < least_gap_m) return;
  const double a = acceleration_behind(traffic.law[k], behind->speed_mps, &own, gap_m);
  if (a < -traffic.law[k].comfortable_braking_mps2) return;
  traffic.acceleration_mps2[k] = std::min(traffic.acceleration_mps2[k], a);
}

}  // namespace

void mark_lanes(std::span<const Wreck> wrecks, LaneOrder& order) {
  for (const Wreck& wreck : wrecks)
    for (const int lane : wreck.lanes)
      if (lane > 0 && lane < static_cast<int>(order.has_straddlers.size()))
        order.has_straddlers[static_cast<std::size_t>(lane)] = wreck_in_lane;
}

void mind_wrecks(std::span<const Wreck> wrecks, CorridorTraffic& traffic) {
  if (wrecks.empty()) return;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] == 0 || traffic.emergency[i] != 0) continue;
    if (changes_lane(traffic, i)) {
      finish_before(traffic, wrecks, i);
      continue;
    }
    const Detour detour = detour_round(traffic, wrecks, i, traffic.lane[i]);
    if (detour.gap_m == no_leader) continue;
    const double room_m = room_to_turn_out_m(traffic, i, detour.lanes, Turning::at_ease);
    keep_room(traffic, i, detour, room_m);
    if (detour.lanes == 0 || traffic.speed_mps[i] > waits_mps || detour.gap_m > room_m + waits_within_m) continue;
    if (can_turn_out(traffic, i, detour) && is_first_in_lane(traffic, i, detour.gap_m))
      let_in(traffic, i, traffic.lane[i] + (detour.lanes > 0 ? 1 : -1));
  }
}

}  // namespace septet::traffic
