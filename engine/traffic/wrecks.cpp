#include "engine/traffic/wrecks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace septet::traffic {
namespace {

constexpr double clearance_m = 0.3;  ///< As those that follow need it beside a body (follow.cpp).
constexpr double look_ahead_m = 300.0;
/// Bodies nearer to each other than this, along the road, are passed at one go.
constexpr double one_place_m = 60.0;
constexpr double hardest_stop = 2.0;  ///< Times the comfortable braking, to keep room to turn out.
constexpr double stands_mps = 0.1, waits_mps = 6.0, waits_within_m = 30.0;

/// Distance from a vehicle's front to a body that it has not reached; negative beyond.
double ahead_m(const CorridorTraffic& traffic, std::size_t i, const Wreck& wreck) {
  return distance_m(traffic.corridor, traffic.x_m[i], wreck.rear_x_m);
}

bool closes(const CorridorTraffic& traffic, const Wreck& wreck, std::size_t i, int lane) {
  if (std::ranges::find(wreck.lanes, lane) == wreck.lanes.end()) return false;
  const double middle_m = -lane * traffic.table.lane_width_m, half_m = traffic.half_width_m[i] + clearance_m;
  return wreck.left_m > middle_m - half_m && wreck.right_m < middle_m + half_m;
}

/// Distance to the nearest body that closes the lane between `from_m` and `to_m` ahead.
double closed_at_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane,
                   double from_m, double to_m) {
  double nearest_m = no_leader;
  for (const Wreck& wreck : wrecks) {
    const double there_m = ahead_m(traffic, i, wreck);
    if (there_m >= from_m && there_m <= to_m && there_m < nearest_m && closes(traffic, wreck, i, lane))
      nearest_m = there_m;
  }
  return nearest_m;
}

/// Nobody of its lane is between it and the body but one who leaves the lane.
bool is_first_in_lane(const CorridorTraffic& traffic, std::size_t i, double gap_m) {
  for (const LaneEntry& entry : traffic.order.lanes[static_cast<std::size_t>(traffic.lane[i])]) {
    if (entry.vehicle < 0 || entry.vehicle == static_cast<std::int32_t>(i)) continue;
    const double there_m = distance_m(traffic.corridor, traffic.x_m[i], entry.x_m);
    const bool leaves = traffic.lane[static_cast<std::size_t>(entry.vehicle)] != traffic.lane[i];
    if (there_m > 0.0 && there_m < gap_m + 1.0 && !leaves) return false;
  }
  return true;
}

/// The next one behind it in the lane that it is to change to leaves it a gap, if mild braking is enough for that.
void let_in(CorridorTraffic& traffic, std::size_t i, int lane) {
  const double rear_x_m = traffic.x_m[i] - traffic.length_m[i];
  std::uint32_t hint = 0;
  const LaneEntry* behind = neighbours(traffic, lane, rear_x_m, static_cast<std::int32_t>(i), hint).behind;
  if (behind == nullptr || behind->vehicle < 0) return;
  const auto k = static_cast<std::size_t>(behind->vehicle);
  LaneEntry own = entry_of(traffic, i);
  if (traffic.lane[k] != lane) return;
  // So much that the change is safe (lane_change.cpp), and not only just.
  constexpr double more_m = 2.5;
  const double gap_m = gap_to(traffic, lane, behind->x_m, &own) - more_m;
  if (gap_m < 0.5) return;
  const double a = acceleration_behind(traffic.law[k], behind->speed_mps, &own, gap_m);
  if (a < -traffic.law[k].comfortable_braking_mps2 || traffic.emergency[k] != 0) return;
  traffic.acceleration_mps2[k] = std::min(traffic.acceleration_mps2[k], a);
}

}  // namespace

Detour detour_round(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane) {
  Detour detour;
  if (wrecks.empty()) return detour;
  detour.gap_m = closed_at_m(traffic, wrecks, i, lane, 0.0, look_ahead_m);
  if (detour.gap_m == no_leader) return detour;
  const double x_m = wrap_x(traffic.corridor, traffic.x_m[i] + detour.gap_m);
  const auto is_open = [&](int other) {
    if (other < 1 || other >= static_cast<int>(traffic.table.open.size())) return false;
    if (lane_end_m(traffic.table, other, x_m) < x_m + one_place_m) return false;
    return closed_at_m(traffic, wrecks, i, other, 0.0, detour.gap_m + one_place_m) == no_leader;
  };
  const int most = static_cast<int>(traffic.table.open.size());
  for (int away = 1; away < most; ++away)
    for (const int side : {-1, 1})
      if (detour.lanes == 0 && is_open(lane + side * away)) detour.lanes = side * away;
  return detour;
}

double room_to_turn_out_m(const CorridorTraffic& traffic, std::size_t i, int changes) {
  return changes * change_length_m(traffic, i, 0.0) + traffic.law[i].standstill_gap_m;
}

bool can_turn_out(const CorridorTraffic& traffic, std::size_t i, const Detour& detour) {
  // The last change need not be over where the body begins.
  constexpr double not_needed = 0.25;
  return detour.gap_m >=
         room_to_turn_out_m(traffic, i, std::abs(detour.lanes)) - not_needed * change_length_m(traffic, i, 0.0);
}

std::vector<Wreck> with_the_stuck(std::span<const Wreck> wrecks, const CorridorTraffic& traffic) {
  std::vector<Wreck> all(wrecks.begin(), wrecks.end());
  if (wrecks.empty()) return all;
  std::vector<std::uint8_t> is_stuck(traffic.size(), 0);
  for (bool found = true; found;) {
    found = false;
    for (std::size_t i = 0; i < traffic.size(); ++i) {
      if (is_stuck[i] != 0 || traffic.lane[i] == 0 || traffic.speed_mps[i] > stands_mps) continue;
      if (changes_lane(traffic, i)) continue;
      const Detour detour = detour_round(traffic, all, i, traffic.lane[i]);
      if (detour.lanes == 0 || can_turn_out(traffic, i, detour)) continue;
      const Across body = across(traffic, i);
      all.push_back({wrap_x(traffic.corridor, traffic.x_m[i] - traffic.length_m[i]),
                     traffic.length_m[i],
                     body.middle_m - body.half_width_m,
                     body.middle_m + body.half_width_m,
                     {traffic.lane[i]}});
      is_stuck[i] = 1;
      found = true;
    }
  }
  return all;
}

void mind_wrecks(std::span<const Wreck> wrecks, CorridorTraffic& traffic) {
  if (wrecks.empty()) return;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] == 0 || traffic.emergency[i] != 0) continue;
    const Detour detour = detour_round(traffic, wrecks, i, traffic.lane[i]);
    if (detour.lanes == 0) continue;
    const double v = traffic.speed_mps[i];
    const double room_m = room_to_turn_out_m(traffic, i, std::abs(detour.lanes));
    const double stands_m = traffic.law[i].standstill_gap_m;
    double to_stop_m = detour.gap_m - room_m + stands_m;
    // A change that has begun is finished first.
    if (changes_lane(traffic, i))
      to_stop_m = std::max(to_stop_m, (1.0 - traffic.change_part[i]) * change_length_m(traffic, i, v) + stands_m + 0.5);
    if (to_stop_m > 0.0) {
      constexpr LaneEntry stop{};
      const double a = acceleration_behind(traffic.law[i], v, &stop, to_stop_m);
      const double least = -hardest_stop * traffic.law[i].comfortable_braking_mps2;
      traffic.acceleration_mps2[i] = std::min(traffic.acceleration_mps2[i], std::max(a, least));
    }
    if (changes_lane(traffic, i) || v > waits_mps || detour.gap_m > room_m + waits_within_m) continue;
    if (is_first_in_lane(traffic, i, detour.gap_m)) let_in(traffic, i, traffic.lane[i] + (detour.lanes > 0 ? 1 : -1));
  }
}

}  // namespace septet::traffic
