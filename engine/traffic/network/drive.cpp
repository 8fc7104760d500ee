#include <algorithm>
#include <cmath>

#include "engine/traffic/lane_way.hpp"
#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double settles_s = 0.5;
constexpr double hardest_settling_mps2 = 6.0;
constexpr double before_line_mps2 = 2.0;
/// A limit that has fallen is met by letting the car roll.
constexpr double coasting_mps2 = 1.0;

/// Acceleration that keeps to a speed whose square falls by 2·`leads` a metre.
double keeping_to(double square_m2ps2, double leads_mps2, double speed_mps) {
  return leads_mps2 + (std::sqrt(std::max(square_m2ps2, 0.0)) - speed_mps) / settles_s;
}

/// True for what lies where the vehicle turns out round it.
bool is_passed(const TownVehicle& vehicle, double to_way_m, const Presence& other) {
  if (!vehicle.swerve || other.speed_mps > 0.1) return false;
  return to_way_m + other.front_m > vehicle.swerve->from_m &&
         to_way_m + other.front_m < vehicle.swerve->to_m - vehicle.length_m();
}

/// Acceleration up to the speed at which a vehicle turns out, from before its swerve until its rear is back.
double bound_by_swerve(const TownVehicle& vehicle, double mps) {
  const double to_begin_m = vehicle.swerve->from_m - swerve_m - (vehicle.front_m - vehicle.length_m());
  const double square = swerve_mps * swerve_mps + 2.0 * coasting_mps2 * std::max(0.0, to_begin_m - vehicle.length_m());
  return keeping_to(square, 0.0, mps);
}

}  // namespace

Leader leader_of(const LaneGraph& graph, const Presences& presences, const TownState& town, std::size_t index) {
  const TownVehicle& vehicle = town.vehicles[index];
  const auto self = static_cast<std::int32_t>(index);
  Leader leader;
  const auto consider = [&](double gap_m, const Presence& other) {
    if (gap_m < leader.gap_m) leader = {gap_m, other.speed_mps, other.who};
  };
  double begin_m = 0.0;
  for (std::size_t k = 0; k < vehicle.route.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    const double front_m = vehicle.front_m - begin_m;  // From the way's begin.
    if (-front_m > horizon_m || -front_m > leader.gap_m) break;
    begin_m += way.length_m;
    if (front_m > way.length_m) continue;
    const double to_way_m = begin_m - way.length_m;
    for (const Presence& other : presences.on(vehicle.route[k]))
      if (other.who != self && other.is_there() && other.front_m > front_m && other.rear_m < way.length_m &&
          !is_passed(vehicle, to_way_m, other))
        consider(other.rear_m - front_m, other);
    if (!way.in_junction() && way.conflicts.count == 0) continue;
    for (const WayConflict& conflict : graph.conflicts_of(way)) {
      if (conflict.kind == WayConflict::Kind::crossing || front_m > conflict.to_m) continue;
      const Way& his = graph.ways[conflict.with];
      for (const Presence& other : presences.on(conflict.with)) {
        if (other.who == self || !other.is_there() || other.rear_m > conflict.with_to_m) continue;
        // Both begin together: the same distance from there. Both end together: the same distance to there.
        const double shift_m = conflict.kind == WayConflict::Kind::diverging
                                   ? his.from_entry_m - way.from_entry_m
                                   : way.length_m + way.to_exit_m - his.length_m - his.to_exit_m;
        if (conflict.kind == WayConflict::Kind::merging && other.front_m < conflict.with_from_m) continue;
        if (other.front_m + shift_m <= front_m) continue;
        const double gap_m = other.rear_m + shift_m - front_m;
        // Up to where the ways meet there is room in any case: that is a line, and no bumper to keep a gap to.
        const double to_line_m = conflict.from_m - front_m;
        const double beyond_m = to_line_m > 0.0 ? vehicle.driver.following.standstill_gap_m : 0.0;
        consider(conflict.kind == WayConflict::Kind::merging ? std::max(gap_m, to_line_m + beyond_m) : gap_m, other);
      }
    }
  }
  return leader;
}

double acceleration_before(double stop_m, double free_in_s, double speed_mps) {
  constexpr double stands_before_m = 0.2;
  const double to_m = stop_m - stands_before_m, v = speed_mps;
  if (to_m <= 0.0) return -before_line_mps2 - v / settles_s;
  const bool rolls_on = v * free_in_s < 2.0 * to_m;
  const double evenly = rolls_on ? 2.0 * (to_m - v * free_in_s) / (free_in_s * free_in_s) : -v * v / (2.0 * to_m);
  return std::max(keeping_to(2.0 * before_line_mps2 * to_m, -before_line_mps2, v), evenly);
}

double acceleration_of(const LaneGraph& graph, const TownVehicle& vehicle, const Leader& leader, double stop_m,
                       double within_mps2) {
  const double v = vehicle.speed_mps;
  const double hurry = std::clamp(1.0 / vehicle.urge, 0.9, 1.05);
  const double own_most = vehicle.driver.following.desired_speed_mps;
  const double length_m = vehicle.length_m();
  double begin_m = 0.0, wanted_mps = own_most, bound = 1e300;
  for (const WayIndex index : vehicle.route) {
    const Way& way = graph.ways[index];
    const double front_m = vehicle.front_m - begin_m;
    begin_m += way.length_m;
    const double limit = std::min(own_most, way.limit_mps * hurry);
    if (front_m >= 0.0 && front_m <= way.length_m) {
      wanted_mps = limit;
      const AllowedSquare square = bend_square_at(graph, way, front_m);
      bound = std::min(bound, keeping_to(square.m2ps2, 0.5 * std::min(square.by_m, 0.0), v));
    } else if (front_m < 0.0) {
      if (-front_m > v * v / (2.0 * coasting_mps2) + 5.0) break;
      const double bend = bend_square_at(graph, way, 0.0).m2ps2 - 2.0 * ease_off_mps2 * front_m;
      if (bend < v * v * 1.5) bound = std::min(bound, keeping_to(bend, -ease_off_mps2, v));
      const double slower = limit * limit - 2.0 * coasting_mps2 * front_m;
      if (slower < v * v * 1.5) bound = std::min(bound, keeping_to(slower, -coasting_mps2, v));
    }
    // Its rear is in the bend still.
    if (front_m > 0.0)
      for (double at = std::max(0.0, front_m - length_m); at < std::min(front_m, way.length_m); at += 2.0) {
        const double curvature = std::abs(curvature_on_way_per_m(graph, way, at));
        bound = std::min(bound, keeping_to(town_bend_mps2 / std::max(curvature, 1e-6), 0.0, v));
      }
  }
  if (vehicle.swerve) bound = std::min(bound, bound_by_swerve(vehicle, v));
  FollowingLaw law = vehicle.law;
  law.inverse_desired_speed = 1.0 / std::max(wanted_mps, 1.0);
  double a = law.acceleration(v, leader.speed_mps, leader.gap_m);
  const double free = std::max(-coasting_mps2, law.acceleration(v, 0.0, no_leader));
  if (leader.gap_m == no_leader) a = free;
  if (stop_m != no_leader) bound = std::min(bound, acceleration_before(stop_m, no_leader, v));
  bound = std::min(bound, within_mps2);
  return std::max(std::min(a, std::max(bound, -hardest_settling_mps2)), -hardest_braking_mps2);
}

}  // namespace septet::traffic
