#include <algorithm>
#include <cmath>

#include "engine/traffic/traffic_parts.hpp"

namespace septet::traffic {
namespace {

constexpr double refused = -no_leader;
constexpr double look_ahead_lane_end_m = 250.0;
constexpr double smallest_gap_m = 2.0;
/// What making room for an emergency vehicle outweighs.
constexpr double leave_lane_bias_mps2 = 3.0;
constexpr double rest_after_change_s = 2.0;

const FollowingLaw& law_of(const CorridorTraffic& traffic, const LaneEntry& entry,
                           std::size_t otherwise) {
  return traffic.law[entry.vehicle >= 0 ? static_cast<std::size_t>(entry.vehicle) : otherwise];
}

/// Acceleration of `behind` with its front bumper at its x and the one ahead's rear bumper at
/// rear_x.
double acceleration_of(const CorridorTraffic& traffic, const LaneEntry& behind, std::size_t self,
                       double gap_m, double ahead_speed_mps) {
  return law_of(traffic, behind, self).acceleration(behind.speed_mps, ahead_speed_mps, gap_m);
}

/// MOBIL, eqs. 2 to 4: the gain of the driver and, politely, of those behind; refused where it is
/// unsafe.
double gain_of_change(const CorridorTraffic& traffic, std::size_t i, int lane, double own_now,
                      const Neighbours& old) {
  const LaneChangeParameters& change = traffic.driver[i].lane_change;
  const double x = traffic.x_m[i], v = traffic.speed_mps[i];
  const auto [ahead, behind] =
      neighbours(traffic, traffic.order.lanes[static_cast<std::size_t>(lane)], x,
                 static_cast<std::int32_t>(i));
  const double gap_ahead = gap_to(traffic, x, ahead);
  if (gap_ahead < smallest_gap_m) return refused;
  double own_then = traffic.law[i].acceleration(v, ahead ? ahead->speed_mps : 0.0, gap_ahead);
  if (own_then < -change.largest_braking_mps2) return refused;
  const double to_end = lane_end_m(traffic.table, lane, x) - x;
  if (to_end < look_ahead_lane_end_m)
    own_then = std::min(own_then, traffic.law[i].acceleration(v, 0.0, to_end));

  LaneEntry own = entry_of(traffic, i);
  double others = 0.0;
  if (behind != nullptr) {
    const double gap = gap_to(traffic, behind->x_m, &own);
    if (gap < smallest_gap_m) return refused;
    const double then = acceleration_of(traffic, *behind, i, gap, v);
    if (then < -change.largest_braking_mps2) return refused;
    const double free_gap = ahead ? gap_to(traffic, behind->x_m, ahead) : no_leader;
    others += then - acceleration_of(traffic, *behind, i, free_gap, ahead ? ahead->speed_mps : 0.0);
  }
  if (old.behind != nullptr) {
    const double gap_now = gap_to(traffic, old.behind->x_m, &own);
    const double gap_then = old.ahead ? gap_to(traffic, old.behind->x_m, old.ahead) : no_leader;
    others +=
        acceleration_of(traffic, *old.behind, i, gap_then, old.ahead ? old.ahead->speed_mps : 0.0) -
        acceleration_of(traffic, *old.behind, i, gap_now, v);
  }
  // Politeness towards a braking tail must not keep anybody at the end of a lane.
  return own_then - own_now +
         change.politeness * std::clamp(others, -2.0 * hardest_braking_mps2, hardest_braking_mps2);
}

void decide(CorridorTraffic& traffic, std::size_t i, double time_s, double interval_s) {
  traffic.next_decision_s[i] = time_s + interval_s;
  const MakingWay way = traffic.making_way[i];
  if (way == MakingWay::hold_lane) return;
  const LaneChangeParameters& change = traffic.driver[i].lane_change;
  const int lane = traffic.lane[i];
  const double x = traffic.x_m[i], v = traffic.speed_mps[i];
  const Neighbours old = neighbours(traffic, traffic.order.lanes[static_cast<std::size_t>(lane)], x,
                                    static_cast<std::int32_t>(i));
  double own_now = traffic.law[i].acceleration(v, old.ahead ? old.ahead->speed_mps : 0.0,
                                               gap_to(traffic, x, old.ahead));
  if (traffic.lane_end_m[i] - x < look_ahead_lane_end_m) {
    own_now = std::min(own_now, traffic.law[i].acceleration(v, 0.0, traffic.lane_end_m[i] - x));
  }
  int best = lane;
  double best_gain = change.threshold_mps2;
  for (const int target : {lane - 1, lane + 1}) {
    const double end = lane_end_m(traffic.table, target, x);
    // Into a lane that ends soon goes only who would be worse off in this one.
    if (end < x || end - x < std::min(look_ahead_lane_end_m, traffic.lane_end_m[i] - x)) continue;
    double gain = gain_of_change(traffic, i, target, own_now, old);
    gain += target > lane ? change.keep_right_mps2 : -change.keep_right_mps2;
    if (way == MakingWay::leave_lane) gain += leave_lane_bias_mps2;
    if (gain > best_gain) {
      best = target;
      best_gain = gain;
    }
  }
  if (best == lane) return;
  traffic.from_lane[i] = static_cast<std::int16_t>(lane);
  traffic.lane[i] = static_cast<std::int16_t>(best);
  traffic.change_s[i] = 0.0;
  traffic.lane_end_m[i] = lane_end_m(traffic.table, best, x);
  // Whoever decides next sees it.
  insert_entry(traffic.order.lanes[static_cast<std::size_t>(best)], entry_of(traffic, i));
}

}  // namespace

void change_lanes(const TrafficParameters& parameters, double time_s, double dt_s,
                  CorridorTraffic& traffic) {
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.emergency[i] != 0 || traffic.lane[i] == 0) continue;
    if (traffic.from_lane[i] != traffic.lane[i]) {
      traffic.change_s[i] += dt_s;
      if (traffic.change_s[i] < traffic.driver[i].lane_change.duration_s) continue;
      traffic.from_lane[i] = traffic.lane[i];
      traffic.next_decision_s[i] = time_s + rest_after_change_s;
    } else if (time_s >= traffic.next_decision_s[i]) {
      decide(traffic, i, time_s, parameters.decision_interval_s);
    }
  }
}

}  // namespace septet::traffic
