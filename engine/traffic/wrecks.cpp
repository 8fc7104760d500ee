#include "engine/traffic/wrecks.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

namespace septet::traffic {
namespace {

constexpr double beside_body_m = 0.35;  ///< A little more than those that follow need beside a body (follow.cpp).
constexpr double look_ahead_m = 300.0;
/// Bodies nearer to each other than this, along the road, are passed at one go.
constexpr double one_place_m = 60.0;
constexpr double shifted_behind_m = 3.0;
constexpr double stands_mps = 0.1;
constexpr double near_m = 1.0;  ///< More than the gap that those leave who have come to rest behind somebody.

/// Distance from a vehicle's front to a body that it has not reached; negative beyond.
double ahead_m(const CorridorTraffic& traffic, std::size_t i, const Wreck& wreck) {
  return distance_m(traffic.corridor, traffic.x_m[i], wreck.rear_x_m);
}

bool reaches_into(const Wreck& wreck, int lane) { return std::ranges::find(wreck.lanes, lane) != wreck.lanes.end(); }

/// The least shift in a lane with which the vehicle passes a body; nothing where there is no room.
std::optional<double> shift_in_lane_m(const CorridorTraffic& traffic, const Wreck& wreck, std::size_t i, int lane) {
  if (!reaches_into(wreck, lane)) return 0.0;
  const double middle_m = -lane * traffic.table.lane_width_m, half_m = traffic.half_width_m[i] + beside_body_m;
  const double to_right_m = middle_m - (wreck.right_m - half_m), to_left_m = wreck.left_m + half_m - middle_m;
  if (to_right_m <= 0.0 || to_left_m <= 0.0) return 0.0;
  const double room_m = to_line_m(traffic, i);
  const bool is_right_free = to_right_m <= room_m + (lane == traffic.table.highest ? on_to_hard_strip_m : 0.0);
  const bool is_left_free = to_left_m <= room_m + (lane == traffic.table.lowest ? on_to_hard_strip_m : 0.0);
  if (is_right_free && (!is_left_free || to_right_m < to_left_m)) return -to_right_m;
  return is_left_free ? std::optional(to_left_m) : std::nullopt;
}

/// Distance to the nearest body up to there that closes the lane.
double closed_at_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane,
                   double to_m) {
  double nearest_m = no_leader;
  for (const Wreck& wreck : wrecks) {
    const double there_m = ahead_m(traffic, i, wreck);
    if (there_m < 0.0 || there_m > to_m || there_m >= nearest_m) continue;
    if (!shift_in_lane_m(traffic, wreck, i, lane)) nearest_m = there_m;
  }
  return nearest_m;
}

bool is_beside_or_before(const CorridorTraffic& traffic, std::size_t i, const Wreck& wreck) {
  const double there_m = ahead_m(traffic, i, wreck);
  return there_m <= one_place_m && there_m >= -(wreck.length_m + traffic.length_m[i] + shifted_behind_m);
}

/// A vehicle's body and the way to the end of its change of lane, as an obstacle `moved_m` from where it is.
Wreck as_wreck(const CorridorTraffic& traffic, std::size_t i, double moved_m) {
  const Across body = across(traffic, i);
  Wreck wreck{wrap_x(traffic.corridor, traffic.x_m[i] - traffic.length_m[i] + moved_m),
              traffic.length_m[i],
              body.middle_m - body.half_width_m,
              body.middle_m + body.half_width_m,
              {traffic.lane[i]}};
  if (traffic.from_lane[i] != traffic.lane[i]) wreck.lanes.push_back(traffic.from_lane[i]);
  return wreck;
}

/// One that stands in the middle of a change, with a body right before it.
bool is_stuck_in_change(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i) {
  if (traffic.speed_mps[i] > stands_mps) return false;
  const Across body = across(traffic, i), then = across_then(traffic, i);
  const double left_m = std::max(body.middle_m + body.half_width_m, then.middle_m + then.half_width_m);
  const double right_m = std::min(body.middle_m - body.half_width_m, then.middle_m - then.half_width_m);
  return std::ranges::any_of(wrecks, [&](const Wreck& wreck) {
    const double gap_m = ahead_m(traffic, i, wreck);
    return gap_m >= 0.0 && gap_m < traffic.law[i].standstill_gap_m + near_m && wreck.left_m + beside_body_m > right_m &&
           wreck.right_m - beside_body_m < left_m;
  });
}

/// A vehicle that can get past these bodies no more, as an obstacle where it is or will come to rest.
std::optional<Wreck> stuck(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i) {
  if (changes_lane(traffic, i))
    return is_stuck_in_change(traffic, wrecks, i) ? std::optional(as_wreck(traffic, i, 0.0)) : std::nullopt;
  const double v = traffic.speed_mps[i], stands_m = traffic.law[i].standstill_gap_m;
  const Detour detour = detour_round(traffic, wrecks, i, traffic.lane[i]);
  if (detour.gap_m == no_leader) return std::nullopt;
  // Without a way round it waits, as far away, and everybody else goes round it.
  const double room_m = detour.lanes == 0 ? room_to_turn_out_m(traffic, i, 0, Turning::at_ease) + spare_m + near_m
                                          : room_to_turn_out_m(traffic, i, detour.lanes, Turning::tight);
  const double way_to_stop_m = v * v / (2.0 * hardest_stop_mps2(traffic, i));
  if (detour.gap_m - way_to_stop_m >= room_m) return std::nullopt;
  return as_wreck(traffic, i, v > stands_mps ? std::max(0.0, detour.gap_m - stands_m) : 0.0);
}

}  // namespace

double closed_ahead_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane) {
  return closed_at_m(traffic, wrecks, i, lane, look_ahead_m);
}

Detour detour_round(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane) {
  Detour detour;
  detour.gap_m = closed_ahead_m(traffic, wrecks, i, lane);
  if (detour.gap_m == no_leader) return detour;
  const double x_m = wrap_x(traffic.corridor, traffic.x_m[i] + detour.gap_m);
  const int lanes = static_cast<int>(traffic.table.open.size());
  const auto is_open = [&](int other) {
    if (other < 1 || other >= lanes) return false;
    if (lane_end_m(traffic.table, other, x_m) < x_m + one_place_m) return false;
    return closed_at_m(traffic, wrecks, i, other, detour.gap_m + one_place_m) == no_leader;
  };
  for (int away = 1; away < lanes; ++away)
    for (const int side : {-1, 1})
      if (detour.lanes == 0 && is_open(lane + side * away)) detour.lanes = side * away;
  const int side = detour.lanes < 0 ? -1 : 1;
  for (int other = lane + side; other != lane + detour.lanes && detour.lanes != 0; other += side)
    detour.gap_m = std::min(detour.gap_m, closed_ahead_m(traffic, wrecks, i, other));
  return detour;
}

bool passes_wreck(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane) {
  return std::ranges::any_of(
      wrecks, [&](const Wreck& wreck) { return reaches_into(wreck, lane) && is_beside_or_before(traffic, i, wreck); });
}

double shift_past_m(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i) {
  double shift_m = 0.0;
  for (const Wreck& wreck : wrecks) {
    if (!is_beside_or_before(traffic, i, wreck)) continue;
    const double one_m = shift_in_lane_m(traffic, wreck, i, traffic.lane[i]).value_or(0.0);
    if (std::abs(one_m) > std::abs(shift_m)) shift_m = one_m;
  }
  return shift_m;
}

double room_to_turn_out_m(const CorridorTraffic& traffic, std::size_t i, int lanes, Turning turning) {
  const double change_m = shortest_change_m(traffic.length_m[i], turning);
  return std::max(1, std::abs(lanes)) * change_m + traffic.law[i].standstill_gap_m;
}

bool can_turn_out(const CorridorTraffic& traffic, std::size_t i, const Detour& detour) {
  return detour.gap_m >= room_to_turn_out_m(traffic, i, detour.lanes, Turning::tight);
}

std::vector<Wreck> with_the_stuck(std::span<const Wreck> wrecks, const CorridorTraffic& traffic) {
  std::vector<Wreck> all(wrecks.begin(), wrecks.end());
  if (wrecks.empty()) return all;
  // From the nearest to the farthest behind: one is stuck because of those ahead.
  std::vector<std::pair<double, std::size_t>> behind;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.lane[i] == 0 || traffic.emergency[i] != 0) continue;
    double nearest_m = no_leader;
    for (const Wreck& wreck : wrecks)
      if (const double there_m = ahead_m(traffic, i, wreck); there_m >= 0.0) nearest_m = std::min(nearest_m, there_m);
    if (nearest_m != no_leader) behind.emplace_back(nearest_m, i);
  }
  std::ranges::sort(behind);
  for (const auto& [there_m, i] : behind)
    if (std::optional<Wreck> one = stuck(traffic, all, i)) all.push_back(std::move(*one));
  return all;
}

}  // namespace septet::traffic
