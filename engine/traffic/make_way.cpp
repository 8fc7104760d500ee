/// Room for emergency vehicles, by the rule of motorways: at 300 m drivers hear and see it, indicate and move aside;
/// those in the left-most lane to the left, all others to the right, so that a lane opens between the left-most lane
/// and the rest. They hold it until the emergency vehicle is 80 m ahead, and close it.

#include <algorithm>
#include <cmath>

#include "engine/traffic/traffic_stages.hpp"
#include "engine/traffic/wrecks.hpp"

namespace septet::traffic {
namespace {

constexpr double heard_at_m = 300.0;
/// Behind it the lane stays open this far: another may follow, as the driver does.
constexpr double kept_open_m = 80.0;
constexpr double clearance_m = 0.3;
constexpr double others_shift_m = 0.35;

/// Target place in its lane of a vehicle of this width that makes room: on the hard strip beside the left-most lane, not
/// over the others' lines.
double aside_for(const CorridorTraffic& traffic, std::size_t i) {
  const int left_most = traffic.table.lowest;
  const double to_edge = to_line_m(traffic, i);
  if (traffic.lane[i] <= left_most) return to_edge + on_to_hard_strip_m;
  return traffic.lane[i] == left_most + 1 ? -to_edge : -std::min(to_edge, others_shift_m);
}

void hear(CorridorTraffic& traffic, std::size_t i, const EmergencyVehicle& emergency, double dt_s) {
  traffic.heard_s[i] += dt_s;
  if (traffic.heard_s[i] < traffic.driver[i].reaction_s) return;
  traffic.aside_target_m[i] = aside_for(traffic, i);
  const double there = -traffic.lane[i] * traffic.table.lane_width_m + traffic.aside_target_m[i];
  const double needed = traffic.half_width_m[i] + emergency.half_width_m + clearance_m;
  const bool enough = std::abs(there - emergency.lateral_m) >= needed;
  traffic.making_way[i] = enough ? MakingWay::hold_lane : MakingWay::leave_lane;
  traffic.any_aside = true;
}

/// A smooth approach of the target: critically damped in time, at low speed along the same path.
void move_aside(CorridorTraffic& traffic, double dt_s) {
  bool any = false;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    if (traffic.emergency[i] != 0) continue;
    double& y = traffic.aside_m[i];
    double& rate = traffic.aside_mps[i];
    const double away = y - traffic.aside_target_m[i];
    if (away == 0.0 && rate == 0.0) continue;
    // Exact for any step: y(t) = target + (c + d t) exp(−t/τ).
    const double t_s = dt_s * std::min(1.0, traffic.speed_mps[i] / slowest_aside_mps);
    const double d = rate + away / aside_time_s;
    const double fade = std::exp(-t_s / aside_time_s);
    const double left = (away + d * t_s) * fade;
    rate = d * fade - left / aside_time_s;
    y = traffic.aside_target_m[i] + left;
    if (std::abs(left) < 1e-4 && std::abs(rate) < 1e-4) {
      y = traffic.aside_target_m[i];
      rate = 0.0;
    }
    any = any || y != 0.0 || traffic.aside_target_m[i] != 0.0;
  }
  traffic.any_aside = any;
}

}  // namespace

void make_way(CorridorTraffic& traffic, const std::vector<EmergencyVehicle>& foreign, std::span<const Wreck> wrecks,
              double dt_s) {
  std::vector<EmergencyVehicle> emergencies = foreign;
  const bool emergency_itself = std::ranges::find(traffic.emergency, 1) != traffic.emergency.end();
  for (std::size_t i = 0; emergency_itself && i < traffic.size(); ++i) {
    if (traffic.emergency[i] == 0 || traffic.lane[i] == 0) continue;
    emergencies.push_back({traffic.x_m[i], traffic.length_m[i], lateral_m(traffic, i), traffic.half_width_m[i]});
  }
  if (emergencies.empty() && wrecks.empty() && !traffic.any_aside) return;
  for (std::size_t i = 0; i < traffic.size(); ++i) {
    traffic.making_way[i] = MakingWay::no;
    if (traffic.emergency[i] != 0 || traffic.lane[i] == 0) continue;
    traffic.aside_target_m[i] = shift_past_m(traffic, wrecks, i);
    bool near = false;
    for (const EmergencyVehicle& emergency : emergencies) {
      const double ahead = distance_m(traffic.corridor, emergency.front_x_m, traffic.x_m[i]);
      if (ahead > heard_at_m + traffic.length_m[i] || ahead < -emergency.length_m - kept_open_m) continue;
      near = true;
      hear(traffic, i, emergency, dt_s);
    }
    if (!near) traffic.heard_s[i] = 0.0;
  }
  move_aside(traffic, dt_s);
  traffic.any_aside = traffic.any_aside || emergency_itself;
}

}  // namespace septet::traffic
