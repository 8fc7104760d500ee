#pragma once
/// The stages of one tick of traffic and what they share. Used by engine/traffic only.

#include <span>
#include <vector>

#include "engine/traffic/lateral.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

/// Somebody with beacon or siren on.
struct EmergencyVehicle {
  double front_x_m = 0.0, length_m = 0.0;
  double lateral_m = 0.0, half_width_m = 0.0;
};

/// What a corridor has to know of the vehicles that others move.
struct ForeignTraffic {
  struct Entry {
    int lane = 0;
    LaneEntry entry;
  };
  std::vector<Entry> entries;
  std::vector<EmergencyVehicle> emergencies;
};

/// From where on the end of a lane matters to whoever drives in it.
inline constexpr double look_ahead_lane_end_m = 250.0;

/// The `vehicle` of an entry that is shown where it is not.
inline constexpr std::int32_t nobody_here = -1'000'000;

/// One per corridor. Keeps where foreign vehicles are and how fast, for the next tick.
std::vector<ForeignTraffic> place_foreign(const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign,
                                          double dt_s, TrafficState& state);

LaneEntry entry_of(const CorridorTraffic& traffic, std::size_t vehicle);
/// Takes places and speeds into the order, drops who has left a lane, adds the foreign vehicles.
void refresh_order(CorridorTraffic& traffic, const ForeignTraffic& foreign);

/// Nearest entries around x in a lane, not counting `self` (−1: count all); null where there is
/// none. `hint` is where the last answer was and is kept up.
struct Neighbours {
  const LaneEntry* ahead = nullptr;
  const LaneEntry* behind = nullptr;
};
Neighbours neighbours(const CorridorTraffic& traffic, int lane, double x_m, std::int32_t self, std::uint32_t& hint);

/// A way ahead on a ring is never negative.
inline double way_ahead_m(const Corridor& corridor, double d) {
  return corridor.closed && d < 0.0 ? d + corridor.length_m : d;
}
/// Where the vehicle frame's origin is: below the rear axle.
inline double rear_axle_x_m(const CorridorTraffic& traffic, std::size_t vehicle) {
  return traffic.x_m[vehicle] - vehicle_models()[traffic.model[vehicle]].front_m();
}
/// From a front bumper at x to the rear bumper of the one ahead; infinite if there is none.
inline double gap_to(const CorridorTraffic& traffic, double x_m, const LaneEntry* ahead) {
  return ahead == nullptr ? no_leader : way_ahead_m(traffic.corridor, ahead->x_m - x_m) - ahead->length_m;
}

/// As the vehicle drives behind this entry; null: nobody.
inline double acceleration_behind(const FollowingLaw& law, double speed_mps, const LaneEntry* ahead, double gap_m) {
  if (ahead == nullptr) return law.acceleration(speed_mps, 0.0, no_leader);
  const double idm_mps2 = law.acceleration(speed_mps, ahead->speed_mps, gap_m);
  // Ordinary following, where coolness would take 0.1 m/s² off at most: of most, most of the time.
  if (idm_mps2 >= -0.5 * law.comfortable_braking_mps2) return idm_mps2;
  return law.with_coolness(idm_mps2, speed_mps, ahead->speed_mps, ahead->acceleration_mps2, gap_m);
}

/// Stage 1: everybody's acceleration.
void follow(CorridorTraffic& traffic);
/// Stage 2: who makes way for an emergency vehicle, and how far aside.
void make_way(CorridorTraffic& traffic, const std::vector<EmergencyVehicle>& foreign, double dt_s);
/// Stage 3: lane changes of those whose turn it is to think.
void change_lanes(const TrafficParameters& parameters, const road::RoadNetwork& network, double time_s, double dt_s,
                  CorridorTraffic& traffic);
/// Stage 4: speeds and places.
std::uint32_t move(CorridorTraffic& traffic, double dt_s);
/// Stage 5: who left the simulation comes in again.
void recycle(const TrafficParameters& parameters, double middle_x_m, Random& random, CorridorTraffic& traffic);
/// A swarm is a ring that travels with its middle: beyond each rim goes on what is at the other, so
/// that its density lasts. Whoever is there sees the other rim's nearest vehicle.
void show_across_rims(const TrafficParameters& parameters, double middle_x_m, const CorridorTraffic& traffic,
                      ForeignTraffic& seen);

/// Ramps of the corridors that there are so far, each with a corridor of its own.
void add_ramps(const road::RoadNetwork& network, TrafficState& state);
/// The exit that this vehicle is about to take; null for most.
const RampMouth* exit_ahead(const CorridorTraffic& traffic, std::size_t vehicle, double exit_share);
/// Who drives towards a mouth sees the last one beyond it.
void show_across_mouths(const TrafficState& state, std::vector<ForeignTraffic>& seen);
/// Stage 6: who has driven through a mouth goes on in the other corridor.
void take_ramps(TrafficState& state);

}  // namespace septet::traffic
