#pragma once
/// Traffic: car following (IDM) and lane changes (MOBIL) on the corridors of a road network.
///
/// Sources: M. Treiber, A. Hennecke and D. Helbing, "Congested traffic states in empirical observations and microscopic
/// simulations" (2000), eqs. 2–4 (IDM); A. Kesting, M. Treiber and D. Helbing, "General lane-changing model MOBIL for
/// car-following models" (2007). Vehicles live in flat arrays; each lane keeps its vehicles in order, so that a leader is the
/// next entry. Vehicles that others move (the driver's car, the storyboard's) take part as obstacles and leaders.
/// Same parameters, foreign vehicles and random state: same traffic. No file, clock or GPU.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/hash.hpp"
#include "engine/core/random.hpp"
#include "engine/traffic/corridor.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::traffic {

/// The intelligent driver model's parameters, of one driver.
struct FollowingParameters {
  double desired_speed_mps = 33.3;
  double time_gap_s = 1.4;
  double acceleration_mps2 = 1.5;
  double comfortable_braking_mps2 = 2.5;
  double standstill_gap_m = 2.0;
};

struct LaneChangeParameters {
  double politeness = 0.2;
  double threshold_mps2 = 0.2;
  double keep_right_mps2 = 0.15;        ///< Bias towards the outer lanes.
  double largest_braking_mps2 = 3.0;    ///< That a change may force on the one behind.
  double duration_s = 4.5;              ///< From lane to lane.
};

/// A kind of vehicle with its share of the traffic and the spread of its drivers.
struct VehicleClass {
  ModelIndex model = 0;
  double share = 1.0;
  FollowingParameters following;
  double desired_speed_spread = 0.08;  ///< Standard deviation, relative.
  double time_gap_spread = 0.2;
};

struct TrafficParameters {
  std::vector<VehicleClass> classes;
  LaneChangeParameters lane_change;
  std::uint32_t count = 0;         ///< Vehicles in all.
  double radius_m = 1500.0;        ///< Around the driver's car; who falls out of it comes in again at its other rim.
  double opposite_share = 0.4;     ///< Of the vehicles that drive the other way.
  ParticipantId first_id = 1000;
};

/// The plain mix of a motorway: hatchbacks, saloons, estates, SUVs, vans and lorries.
TrafficParameters motorway_traffic(std::uint32_t count, double radius_m);

/// A vehicle that someone else moves.
struct ForeignVehicle {
  ParticipantId id = 0;
  ModelIndex model = 0;
  RigidTransform world_from_vehicle;
  Vec3 velocity_mps{0.0};
  Lamps lamps;
};

/// One corridor's vehicles, one entry per vehicle in every array. x is that of the front bumper.
struct CorridorTraffic {
  Corridor corridor;
  int lanes = 0;  ///< Highest lane number that is open anywhere.

  std::vector<ParticipantId> id;
  std::vector<ModelIndex> model;
  std::vector<std::uint8_t> paint;
  std::vector<FollowingParameters> following;
  std::vector<double> x_m, speed_mps, acceleration_mps2, wheel_spin_rad;
  std::vector<std::int16_t> lane, from_lane;  ///< Equal unless a change is going on.
  std::vector<double> change_s;               ///< Time into the change.
  std::vector<double> next_decision_s;
  std::vector<double> length_m;

  std::size_t size() const { return id.size(); }
};

struct TrafficState {
  std::vector<CorridorTraffic> corridors;
  double time_s = 0.0;
  std::vector<std::optional<road::RoadPosition>> foreign_places;  ///< Hints, one per foreign vehicle.
};

/// Vehicles around the first foreign vehicle (the driver's car), clear of all of them.
TrafficState populate(const TrafficParameters& parameters, const road::RoadNetwork& network,
                      std::span<const ForeignVehicle> foreign, Random& random);

/// One tick on. `foreign` has the same vehicles in the same order each time; the first one is the swarm's middle.
void advance(const TrafficParameters& parameters, const road::RoadNetwork& network, std::span<const ForeignVehicle> foreign,
             double dt_s, Random& random, TrafficState& state);

/// IDM, eq. 3 and 4: acceleration at `speed` behind a leader `gap` ahead; no leader: gap infinite.
double idm_acceleration(const FollowingParameters& driver, double speed_mps, double leader_speed_mps, double gap_m);

void append_participants(const TrafficState& state, const road::RoadNetwork& network, std::vector<Participant>& participants);
void hash_state(StateHash& hash, const TrafficState& state);

}  // namespace septet::traffic
