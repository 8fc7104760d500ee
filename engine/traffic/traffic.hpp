#pragma once
/// Traffic: car following (IDM), lane changes (MOBIL) and room for emergency vehicles, on the corridors of a road
/// network.
///
///     TrafficState traffic = populate(parameters, network, foreign, random);
///     each tick:  advance(parameters, network, foreign, tick_s, random, traffic);
///                 append_participants(traffic, network, participants);
///
/// Vehicles live in flat arrays; every lane keeps its vehicles in order (lane_order.hpp), so that a leader is the next
/// entry. Vehicles moved by other stages (the driver's car, the storyboard's) take part as leaders and followers like
/// any other. Lateral movement is a function of the distance driven (lateral.hpp): a standing vehicle does not move
/// sideways, and no vehicle drives a bend too tight for a car. Same parameters, foreign vehicles and random state: same
/// traffic. No file, clock or GPU. One thread per state.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/hash.hpp"
#include "engine/core/random.hpp"
#include "engine/traffic/corridor.hpp"
#include "engine/traffic/driver.hpp"
#include "engine/traffic/lane_order.hpp"
#include "engine/traffic/lane_table.hpp"
#include "engine/traffic/lane_way.hpp"
#include "engine/traffic/line_table.hpp"
#include "engine/world/limited_sight.hpp"
#include "engine/world/participant_shape.hpp"
#include "engine/world/people_errors.hpp"
#include "engine/world/snapshot.hpp"

namespace septet::traffic {

/// A kind of vehicle with its share of the traffic and the spread of its drivers.
struct VehicleClass {
  ModelIndex model = 0;
  double share = 1.0;
  Driver middle;                    ///< The driver of temperament 0.5.
  double temperament_spread = 1.0;  ///< 0: all alike; 1: from timid to aggressive (with_temperament).
};

struct TrafficParameters {
  std::vector<VehicleClass> classes;
  std::uint32_t count = 0;      ///< Vehicles in all.
  double radius_m = 1500.0;     ///< Around the driver's car; a vehicle that leaves it comes in again at its other rim.
  double opposite_share = 0.4;  ///< Share of the vehicles in the other direction.
  double exit_share = 0.1;      ///< Share of the vehicles passing an exit that take it.
  double decision_interval_s = 0.5;  ///< Interval of a driver's decisions on lane changes; drivers take turns.
  ParticipantId first_id = 1000;
  std::uint32_t worsened = 0;  ///< Steps of worse manners (with_worse_manners) taken by all drivers.
  PeopleErrorRates errors;     ///< Of traffic on a network (network/errors.hpp).
};

/// The plain mix of a motorway: hatchbacks, saloons, estates, SUVs, motorcycles, vans and lorries.
TrafficParameters motorway_traffic(std::uint32_t count, double radius_m);

/// Gives each kind of vehicle this share of the traffic, split among its classes as before. Kinds that are not named
/// get zero, kinds without a class are left out; an empty list changes nothing.
struct KindShare {
  ParticipantKind kind = ParticipantKind::car;
  double share = 0.0;
};
void set_mix(TrafficParameters& parameters, std::span<const KindShare> mix);

/// A vehicle moved by another stage. With beacon or siren on, traffic makes way for it.
struct ForeignVehicle {
  ParticipantId id = 0;
  ModelIndex model = 0;
  RigidTransform world_from_vehicle;
  Vec3 velocity_mps{0.0};
  Lamps lamps;
  /// It has left the lanes after a crash, or never was on them: it lies as it lies, across several of them or beside.
  bool adrift = false;
  std::optional<Vec3> box_size_m = {};  ///< Of a box (engine/world/participant_shape.hpp).

  VehicleModel shape() const { return shape_of(model, box_size_m); }
};

/// A driver comes to see those to whom he gives way at a junction, so far before its line, after they had been hidden.
struct ViewOpening {
  ParticipantId driver = 0;
  double line_m = 0.0, hidden_s = 0.0;
};

/// An emergency vehicle's demand on a driver.
enum class MakingWay : std::uint8_t { no, hold_lane, leave_lane };

/// Place where a ramp leaves or meets a corridor.
struct RampMouth {
  double x_m = 0.0;
  int lane = 0;
};

/// One corridor's vehicles, one entry per vehicle in every array. x is that of the front bumper, the length of the body
/// before the rear axle counted as on a straight line.
struct CorridorTraffic {
  Corridor corridor;
  LaneTable table;
  LineTable line;
  LaneWays ways;

  std::vector<ParticipantId> id;
  std::vector<ModelIndex> model;
  std::vector<std::uint8_t> paint;
  std::vector<Driver> driver;
  std::vector<FollowingLaw> law;                          ///< Law of the driver.
  std::vector<double> x_m, speed_mps, acceleration_mps2;  ///< Speed and acceleration along the path, not by x.
  std::vector<double> rolled_m;                           ///< Path length rolled; at entry it equals x.
  std::vector<std::int16_t> lane,
      from_lane;                    ///< The other lane it stands in; its own unless it changes. 0: waits outside.
  std::vector<double> change_part;  ///< Part of a change of lane that is done; 1: none is going on.
  std::vector<double> change_offset_m, change_run_m;  ///< Its initial offset and slope (lateral.cpp).
  std::vector<double> change_shortest_m;              ///< Its length at walking speed.
  std::vector<double> next_decision_s;
  std::vector<double> lane_end_m;  ///< x at which the lane ends.
  std::vector<double> length_m, half_width_m;
  std::vector<double> aside_m,
      aside_mps;  ///< From the middle of the lane, to the left of travel, and its rate at speed.
  std::vector<double> aside_target_m;
  std::vector<double> heard_s;  ///< Time for which an emergency vehicle has been near.
  std::vector<MakingWay> making_way;
  std::vector<std::uint8_t> emergency;  ///< True for an emergency vehicle itself.
  /// Last indices of the neighbours in the left, own and right lane.
  std::vector<std::array<std::uint32_t, 3>> neighbour_hints;
  bool any_aside = false;  ///< Some vehicle is off its lane's middle.

  LaneOrder order;
  std::vector<RampMouth> exits;  ///< Exits to ramps that lead back to the corridor.

  std::size_t size() const { return id.size(); }
};

/// A ramp: out by an exit lane, in again by an entry lane. Vehicles on it drive in a corridor of its own.
struct Ramp {
  std::size_t main = 0, way = 0;  ///< Indices in TrafficState::corridors.
  RampMouth exit, entry;          ///< On the main corridor.
  int lane = 1;                   ///< On the ramp.
};

struct TrafficState {
  std::vector<CorridorTraffic> corridors;  ///< The directions of travel, then the ramps.
  std::vector<Ramp> ramps;
  double time_s = 0.0;
  std::vector<LimitedSight> sights;                               ///< The caller's, of this tick.
  std::vector<std::optional<road::RoadPosition>> foreign_places;  ///< Hints, one per foreign vehicle.
  std::vector<double> foreign_speeds_mps;                         ///< Speeds a tick ago.
  std::vector<double> foreign_stands_s;                           ///< For how long each has stood.
  /// Time since each one's left and right indicator were lit.
  std::vector<std::array<double, 2>> foreign_signals_s;
  std::uint32_t bad_numbers = 0;    ///< Accelerations that were NaN, and were replaced by 0.
  ParticipantId removed_below = 0;  ///< Numbers of removed vehicles are less: they are not given again.
};

/// Vehicles around the first foreign vehicle (the driver's car), clear of all of them; on a ring all around it.
TrafficState populate(const TrafficParameters& parameters, const road::RoadNetwork& network,
                      std::span<const ForeignVehicle> foreign, Random& random);

/// Adds vehicles in the direction of the first foreign vehicle, which come in at the swarm's rims as they find room,
/// and worsens all drivers' manners by a step.
void worsen(TrafficParameters& parameters, std::uint32_t more, Random& random, TrafficState& state);

/// Advances by one tick. `foreign` has the same vehicles in the same order each time; the first one is the swarm's
/// middle.
void advance(const TrafficParameters& parameters, const road::RoadNetwork& network,
             std::span<const ForeignVehicle> foreign, double dt_s, Random& random, TrafficState& state);

/// A corridor without vehicles, to be filled by the caller.
CorridorTraffic empty_corridor(const road::RoadNetwork& network, const Corridor& corridor);
CorridorTraffic empty_corridor(const road::RoadNetwork& network, const road::LanePosition& through);
/// Adds a vehicle; the caller ensures that its place is free.
void add_vehicle(CorridorTraffic& traffic, ParticipantId id, ModelIndex model, const Driver& driver, int lane,
                 double x_m, double speed_mps);

/// Takes a vehicle out for good; false: there is none of that number.
bool remove_vehicle(ParticipantId id, TrafficState& state);

/// Metres to the left of lane number 0's middle, with the corridor's nominal lane width: falls with the lane number.
double lateral_m(const CorridorTraffic& traffic, std::size_t vehicle);

void append_participants(const TrafficState& state, const road::RoadNetwork& network,
                         std::vector<Participant>& participants);
void hash_state(StateHash& hash, const TrafficState& state);

}  // namespace septet::traffic
