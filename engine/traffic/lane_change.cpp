#include <algorithm>
#include <cmath>
#include <span>

#include "engine/traffic/traffic_stages.hpp"
#include "engine/traffic/wrecks.hpp"

namespace septet::traffic {
namespace {

constexpr double refused = -no_leader;
constexpr double smallest_gap_m = 2.0, smallest_waiting_gap_m = 0.5;
constexpr double creeping_mps = 2.0;
constexpr LaneEntry standing{};  ///< The end of a lane.
/// Bias of making room for an emergency vehicle.
constexpr double leave_lane_bias_mps2 = 3.0;
/// Bias of reaching the exit, and a lane that is open beside a wreck.
constexpr double exit_bias_mps2 = 3.0, detour_bias_mps2 = 3.0;
constexpr double rest_after_change_s = 2.0;

/// The driving law of an entry in the order; a foreign vehicle has that of the deciding driver.
const FollowingLaw& law_of(const CorridorTraffic& traffic, const LaneEntry& entry, std::size_t decider) {
  return traffic.law[entry.vehicle >= 0 ? static_cast<std::size_t>(entry.vehicle) : decider];
}

/// One driver's decision on a change of lane.
struct Decision {
  const CorridorTraffic& traffic;
  std::size_t i;
  double x, v, own_now;
  double old_follower_gain = 0.0;  ///< Gain of the old follower when this vehicle leaves.

  double present_acceleration(const LaneEntry& entry, double otherwise) const {
    return entry.vehicle >= 0 ? traffic.acceleration_mps2[static_cast<std::size_t>(entry.vehicle)] : otherwise;
  }

  /// A follower's acceleration here within limits and bends.
  double bounded(const LaneEntry& entry, int lane, double acceleration_mps2) const {
    const bool is_own = entry.vehicle >= 0;
    const bool emergency = is_own && traffic.emergency[static_cast<std::size_t>(entry.vehicle)] != 0;
    return is_own ? within_bounds(traffic, lane, entry.x_m, entry.speed_mps, emergency, acceleration_mps2)
                  : acceleration_mps2;
  }

  /// MOBIL, eqs. 2 to 4: the gain of the driver and, politely, of the followers; refused where it is unsafe.
  double gain(int lane, double lane_end, bool rounds_wreck, std::uint32_t& hint) const {
    const LaneChangeParameters& change = traffic.driver[i].lane_change;
    const auto [ahead, behind] = neighbours(traffic, lane, x, static_cast<std::int32_t>(i), hint);
    const double gap_ahead = gap_to(traffic, lane, x, ahead);
    if (gap_ahead < smallest_gap_m) return refused;
    const double ahead_speed = ahead != nullptr ? ahead->speed_mps : 0.0;
    // Safety is judged by the stricter law.
    const FollowingLaw& law = traffic.law[i];
    if (law.acceleration(v, ahead_speed, gap_ahead) < -change.largest_braking_mps2) return refused;
    double own_then = within_bounds(traffic, lane, x, v, false, acceleration_behind(law, v, ahead, gap_ahead));
    if (lane_end - x < look_ahead_lane_end_m)
      own_then = std::min(own_then, acceleration_behind(law, v, &standing, to_lane_end_m(traffic, lane, x, lane_end)));
    double others = old_follower_gain;
    if (behind != nullptr) {
      LaneEntry own;
      own.x_m = x;
      own.length_m = static_cast<float>(traffic.length_m[i]);
      own.speed_mps = v;
      own.acceleration_mps2 = static_cast<float>(own_now);
      const double gap = gap_to(traffic, lane, behind->x_m, &own);
      // Who waits for it may stand close.
      const bool both_wait = rounds_wreck && v < creeping_mps && behind->speed_mps < creeping_mps;
      if (gap < (both_wait ? smallest_waiting_gap_m : smallest_gap_m)) return refused;
      const FollowingLaw& law_behind = law_of(traffic, *behind, i);
      if (law_behind.acceleration(behind->speed_mps, v, gap) < -change.largest_braking_mps2) return refused;
      const double then = acceleration_behind(law_behind, behind->speed_mps, &own, gap);
      others += bounded(*behind, lane, then) - present_acceleration(*behind, 0.0);
    }
    return own_then - own_now +
           change.politeness * std::clamp(others, -2.0 * hardest_braking_mps2, hardest_braking_mps2);
  }
};

/// False where a wreck is in the way of the change, or closes the lane that would be entered before the present one;
/// and behind somebody who stands too near to turn out behind him.
bool may_turn_to(const CorridorTraffic& traffic, std::span<const Wreck> wrecks, std::size_t i, int lane,
                 const Detour& detour, const LaneEntry* ahead) {
  if (wrecks.empty()) return true;
  if (detour.lanes * (lane - traffic.lane[i]) > 0) {
    const bool is_behind_slow =
        ahead != nullptr && ahead->speed_mps < creeping_mps && traffic.speed_mps[i] < creeping_mps;
    const Detour behind{is_behind_slow ? gap_to(traffic, traffic.lane[i], traffic.x_m[i], ahead) : no_leader, 1};
    return can_turn_out(traffic, i, detour) && can_turn_out(traffic, i, behind);
  }
  if (detour.lanes != 0) return false;
  if (passes_wreck(traffic, wrecks, i, lane) || passes_wreck(traffic, wrecks, i, traffic.lane[i])) return false;
  const double closed_m = closed_ahead_m(traffic, wrecks, i, lane);
  return closed_m == no_leader || closed_m > detour.gap_m;
}

/// One who turns out without the room for a change at ease steers as far as he can.
Turning turning(const CorridorTraffic& traffic, std::size_t i, const Detour& detour, const LaneEntry* ahead) {
  if (detour.gap_m == no_leader) return Turning::at_ease;
  const double free_m = std::min(detour.gap_m, gap_to(traffic, traffic.lane[i], traffic.x_m[i], ahead));
  return free_m < room_to_turn_out_m(traffic, i, detour.lanes, Turning::at_ease) ? Turning::tight : Turning::at_ease;
}

void decide(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const Wreck> wrecks,
            CorridorTraffic& traffic, std::size_t i, double time_s) {
  traffic.next_decision_s[i] = time_s + parameters.decision_interval_s;
  const MakingWay way = traffic.making_way[i];
  if (way == MakingWay::hold_lane) return;
  const LaneChangeParameters& change = traffic.driver[i].lane_change;
  const int lane = traffic.lane[i];
  const RampMouth* exit = traffic.exits.empty() ? nullptr : exit_ahead(traffic, i, parameters.exit_share);
  if (exit != nullptr && lane == exit->lane) return;
  Decision decision{traffic, i, traffic.x_m[i], traffic.speed_mps[i], traffic.acceleration_mps2[i]};
  const double x = decision.x, rear_x = rear_axle_x_m(traffic, i);
  auto& hints = traffic.neighbour_hints[i];
  const auto old = neighbours(traffic, lane, x, static_cast<std::int32_t>(i), hints[1]);
  if (old.behind != nullptr && change.politeness > 0.0) {
    const double gap = gap_to(traffic, lane, old.behind->x_m, old.ahead);
    const double then = acceleration_behind(law_of(traffic, *old.behind, i), old.behind->speed_mps, old.ahead, gap);
    decision.old_follower_gain =
        decision.bounded(*old.behind, lane, then) - decision.present_acceleration(*old.behind, 0.0);
  }
  const Detour detour = detour_round(traffic, wrecks, i, lane);
  int best = lane;
  double best_gain = change.threshold_mps2;
  for (const int step : {-1, 1}) {
    const int target = lane + step;
    const bool rounds = detour.lanes * step > 0;
    if (!may_turn_to(traffic, wrecks, i, target, detour, old.ahead)) continue;
    if (exit != nullptr && step < 0 && !rounds) continue;
    const bool leaves = exit != nullptr && target == exit->lane;
    double end = lane_end_m(traffic.table, target, x);
    if (leaves && end > x) end = no_leader;
    // The lane has begun at the rear axle, which the table knows to half a step.
    if (lane_end_m(traffic.table, target, rear_x - 0.5 * LaneTable::knot_step_m) < rear_x) continue;
    // A lane that ends soon is entered only by a driver who would be worse off in this one.
    if (end < x || end - x < std::min(look_ahead_lane_end_m, traffic.lane_end_m[i] - x)) continue;
    double gain = decision.gain(target, end, rounds, hints[static_cast<std::size_t>(1 + step)]);
    gain += step * change.keep_right_mps2;
    if (exit != nullptr) gain += exit_bias_mps2;
    if (rounds) gain += detour_bias_mps2;
    if (way == MakingWay::leave_lane) gain += leave_lane_bias_mps2;
    if (gain > best_gain) {
      best = target;
      best_gain = gain;
    }
  }
  if (best == lane) return;
  const auto centre = [&](int of) { return lane_centre_along(network, traffic.corridor, traffic.table, rear_x, of); };
  const LaneCentre here = centre(lane), there = centre(best);
  traffic.from_lane[i] = static_cast<std::int16_t>(lane);
  traffic.lane[i] = static_cast<std::int16_t>(best);
  begin_change(traffic, i, here.t_m - there.t_m, here.slope - there.slope, turning(traffic, i, detour, old.ahead));
  const bool leaves = exit != nullptr && best == exit->lane;
  traffic.lane_end_m[i] = leaves ? no_leader : lane_end_m(traffic.table, best, x);
  // The next decisions see it.
  insert_entry(traffic.order.lanes[static_cast<std::size_t>(best)], entry_of(traffic, i));
}

}  // namespace

void change_lanes(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const Wreck> wrecks,
                  double time_s, double dt_s, CorridorTraffic& traffic) {
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.emergency[i] != 0 || traffic.lane[i] == 0) continue;
    if (!changes_lane(traffic, i) && time_s >= traffic.next_decision_s[i])
      decide(parameters, network, wrecks, traffic, i, time_s);
    if (!changes_lane(traffic, i)) continue;
    const double v = traffic.speed_mps[i];
    traffic.change_part[i] += v * dt_s / change_length_m(traffic, i, v);
    if (changes_lane(traffic, i)) continue;
    traffic.change_part[i] = 1.0;
    traffic.from_lane[i] = traffic.lane[i];
    traffic.next_decision_s[i] = time_s + rest_after_change_s;
  }
}

}  // namespace septet::traffic
