#pragma once
/// The stages of one tick of traffic and their shared data. Used by engine/traffic only.

#include <cmath>
#include <span>
#include <vector>

#include "engine/traffic/lane_way.hpp"
#include "engine/traffic/lateral.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// A vehicle with beacon or siren on.
struct EmergencyVehicle {
  double front_x_m = 0.0, length_m = 0.0;
  double lateral_m = 0.0, half_width_m = 0.0;
};

/// A body that lies on a corridor, a vehicle adrift above all, and the lanes that it reaches into.
struct Wreck {
  double rear_x_m = 0.0, length_m = 0.0;
  double right_m = 0.0, left_m = 0.0;  ///< As lateral_m of traffic.hpp.
  std::vector<int> lanes;
};

/// A corridor's view of the vehicles moved by other stages.
struct ForeignTraffic {
  struct Entry {
    int lane = 0;
    LaneEntry entry;
  };
  std::vector<Entry> entries;
  std::vector<Wreck> wrecks;
  std::vector<EmergencyVehicle> emergencies;
};

/// Distance from which on the end of a lane matters to a vehicle in it.
inline constexpr double look_ahead_lane_end_m = 250.0;

/// The `vehicle` of an entry shown away from its true place.
inline constexpr std::int32_t nobody_here = -1'000'000;

/// One per corridor. Stores the foreign vehicles' places and speeds for the next tick.
std::vector<ForeignTraffic> place_foreign(const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign,
                                          double dt_s, TrafficState& state);

LaneEntry entry_of(const CorridorTraffic& traffic, std::size_t vehicle);
/// Updates places and speeds in the order, drops vehicles that have left a lane, adds the foreign vehicles.
void refresh_order(CorridorTraffic& traffic, const ForeignTraffic& foreign);

/// Nearest entries around x in a lane, not counting `self` (−1: count all); null where there is none. `hint` is the
/// last result's index and is kept up.
struct Neighbours {
  const LaneEntry* ahead = nullptr;
  const LaneEntry* behind = nullptr;
};
Neighbours neighbours(const CorridorTraffic& traffic, int lane, double x_m, std::int32_t self, std::uint32_t& hint);

/// x of the vehicle frame's origin: below the rear axle.
inline double rear_axle_x_m(const CorridorTraffic& traffic, std::size_t vehicle) {
  return traffic.x_m[vehicle] - vehicle_models()[traffic.model[vehicle]].front_m();
}
/// Gap from a front bumper at x to the rear bumper of the one ahead, along the lane; infinite if there is none.
inline double gap_to(const CorridorTraffic& traffic, int lane, double x_m, const LaneEntry* ahead) {
  if (ahead == nullptr) return no_leader;
  const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(lane)];
  return way_between_m(traffic.corridor, way, x_m, ahead->x_m) - ahead->length_m;
}
/// Distance from x to the lane's end, along it.
inline double to_lane_end_m(const CorridorTraffic& traffic, int lane, double x_m, double end_m) {
  const double d = end_m - x_m;
  if (traffic.ways.straight || !(d > 0.0) || d > look_ahead_lane_end_m) return d;
  const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(lane)];
  return way_at_m(way, end_m) - way_at_m(way, x_m);
}
/// An acceleration limited by bends and posted limits in this lane; an emergency vehicle observes the bends alone. NaN
/// stays NaN, to be counted.
inline double within_bounds(const CorridorTraffic& traffic, int lane, double x_m, double speed_mps, bool emergency,
                            double acceleration_mps2) {
  const LaneWay& way = traffic.ways.lanes[static_cast<std::size_t>(lane)];
  if (way.allowed_m2ps2.empty() || !std::isfinite(acceleration_mps2)) return acceleration_mps2;
  const double allowed = allowed_acceleration_mps2(way, x_m, speed_mps, emergency);
  return acceleration_mps2 < allowed ? acceleration_mps2 : allowed;
}
/// The vehicle's rear axle, which points along its path, in the road's terms.
struct PathPoint {
  LineAt at;
  double direction = 1.0;  ///< 1 towards increasing s, −1 against it.
  double t_m = 0.0;        ///< In the road's own sense.
  LineTangent tangent;
  /// Slope of the path against the line of constant t, by a metre of that, to the left of travel.
  double slope = 0.0, curvature_per_m = 0.0;
};
PathPoint path_at(const road::RoadNetwork& network, const CorridorTraffic& traffic, std::size_t vehicle,
                  double rear_axle_x_m);

/// The vehicle's acceleration behind this entry; null: free road.
inline double acceleration_behind(const FollowingLaw& law, double speed_mps, const LaneEntry* ahead, double gap_m) {
  if (ahead == nullptr) return law.acceleration(speed_mps, 0.0, no_leader);
  const double idm_mps2 = law.acceleration(speed_mps, ahead->speed_mps, gap_m);
  // Ordinary following, where coolness would take 0.1 m/s² off at most: of most, most of the time.
  if (idm_mps2 >= -0.5 * law.comfortable_braking_mps2) return idm_mps2;
  return law.with_coolness(idm_mps2, speed_mps, ahead->speed_mps, ahead->acceleration_mps2, gap_m);
}

/// Marks the lanes into which wrecks reach.
void mark_lanes(std::span<const Wreck> wrecks, LaneOrder& order);
/// Stage 1: all accelerations.
void follow(CorridorTraffic& traffic);
/// The hardest braking to keep room before wrecks, at twice the comfortable one.
inline double hardest_stop_mps2(const CorridorTraffic& traffic, std::size_t vehicle) {
  return 2.0 * traffic.law[vehicle].comfortable_braking_mps2;
}
/// Stage 1, continued: room to turn out before wrecks, and for those who turn out.
void mind_wrecks(std::span<const Wreck> wrecks, CorridorTraffic& traffic);
/// Stage 1, continued: nobody goes faster than he can stop within what he sees.
void keep_within_sight(std::span<const LimitedSight> sights, CorridorTraffic& traffic);
/// Stage 2: vehicles that make way for an emergency vehicle, and their shift aside.
void make_way(CorridorTraffic& traffic, const std::vector<EmergencyVehicle>& foreign, std::span<const Wreck> wrecks,
              double dt_s);
/// Stage 3: lane changes of the drivers whose turn it is to decide.
void change_lanes(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const Wreck> wrecks,
                  double time_s, double dt_s, CorridorTraffic& traffic);
/// Stage 4: speeds and places.
std::uint32_t move(const road::RoadNetwork& network, CorridorTraffic& traffic, double dt_s);
/// Stage 5: vehicles that left the simulation come in again; from behind, if the middle stands.
void recycle(const TrafficParameters& parameters, double middle_x_m, bool middle_stands, Random& random,
             CorridorTraffic& traffic);
/// A swarm is a ring that travels with its middle: beyond each rim continues the other one, so that its density lasts.
/// A vehicle there sees the other rim's nearest vehicle.
void show_across_rims(const TrafficParameters& parameters, double middle_x_m, const CorridorTraffic& traffic,
                      ForeignTraffic& seen);

/// Adds ramps of the existing corridors, each with a corridor of its own.
void add_ramps(const road::RoadNetwork& network, TrafficState& state);
/// The exit that this vehicle is about to take; null for most.
const RampMouth* exit_ahead(const CorridorTraffic& traffic, std::size_t vehicle, double exit_share);
/// A vehicle that drives towards a mouth sees the last one beyond it.
void show_across_mouths(const TrafficState& state, std::vector<ForeignTraffic>& seen);
/// Stage 6: vehicles that have driven through a mouth go on in the other corridor.
void take_ramps(TrafficState& state);

}  // namespace septet::traffic
