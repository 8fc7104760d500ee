#pragma once
/// Traffic on a whole road network, junctions included (lane_graph.hpp).
///
///     TownState town = populate_town(parameters, network, graph, foreign, random);
///     each tick:  advance_town(parameters, network, graph, lights, foreign, tick_s, random, town);
///                 append_participants(graph, town, participants);
///
/// A vehicle has a route: the ways from the one that holds its rear to beyond its horizon, drawn at each fork. Two points
/// of its middle line are on the route (body_on_route, town_stages.hpp), so that what it covers of a junction is a function
/// of where it is on it.
///
/// Right of way: a vehicle needs a claim on a junction before it passes the stop line. It gets one when its light
/// allows it, when what lies beyond has room for it (nobody stands within a junction), when no claim or body is on a
/// way that meets its own too near in time, and when the gap to everybody whom it lets pass (`yields_to`) is long
/// enough. Long vehicles wait for each other also where turns lie so close beside each other that only others fit past them.
/// Claims are numbered: who has the later one waits, within the junction at the last, for the earlier one, so that
/// claims never wait in a circle. Who has waited long is let in by those who can stop, and of several who each let the
/// next one pass one goes first (courtesy).
///
/// Nobody claims a junction before its driver has those in view to whom he gives way: past walls, which the graph knows
/// (approach_view.hpp), past vans, lorries and the like, and through smoke and fog. At the line he is taken to see them.
///
/// Foreign vehicles are bodies on whatever ways their outline touches, and come to junctions like others; where they
/// are going is told by their indicator at most.
///
/// Where a vehicle adrift lies on a lane outside of a junction, others pass it over the lane beside it, of their own
/// direction or the other, once nobody is on it or comes; who has come to rest too near to turn out stays.
///
/// Whoever walks on a crossing, or stands at a crosswalk and would go, is let pass by those who can stop; a driver goes on
/// only where he is over it before the other comes to his lane (let_people_pass.cpp).
///
/// Drivers err at the rates of the parameters, or by a wish (errors.hpp).
///
/// Sources: car following driver.hpp; gaps: Highway Capacity Manual (Transportation Research Board, 2010), table 19-10,
/// base critical headways of two-lane streets. Same arguments: same traffic. One thread a state.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/core/random.hpp"
#include "engine/sight/air.hpp"
#include "engine/traffic/crossing.hpp"
#include "engine/traffic/driver.hpp"
#include "engine/traffic/network/errors.hpp"
#include "engine/traffic/network/lane_graph.hpp"
#include "engine/traffic/traffic.hpp"
#include "engine/world/limited_sight.hpp"
#include "engine/world/snapshot.hpp"
#include "engine/world/traffic_light.hpp"

namespace septet::traffic {

/// A way round what lies on a lane, over the lane beside it. Positions are from the route's begin.
struct Swerve {
  WayIndex own = no_way, over = no_way;
  double from_m = 0.0, to_m = 0.0;  ///< In between it is all aside.
  double left_m = 0.0;              ///< By how much, to the left.
};

struct TownVehicle {
  ParticipantId id = 0;
  ModelIndex model = 0;
  std::uint8_t paint = 0;
  Driver driver;
  FollowingLaw law;
  double urge = 1.0;  ///< Of its critical gaps: above 1 for a timid driver.

  bool outside = true;          ///< Waits for room to come in; it is nowhere.
  std::vector<WayIndex> route;  ///< From the way that holds its rear bumper.
  double front_m = 0.0;         ///< Of the front bumper, from the route's begin.
  double speed_mps = 0.0, acceleration_mps2 = 0.0;
  double rolled_m = 0.0;
  /// Numbers of the claims on the ways of the route that it may drive, from its begin. Who claims the next junction keeps
  /// the number that he has in this one.
  std::vector<std::uint64_t> claims;
  double unused_s = 0.0;  ///< For which it has stood with its claim.
  double waits_s = 0.0;   ///< At a stop line without a claim.
  double stands_s = 0.0;  ///< Below walking speed, for whatever cause.
  double hidden_s = 0.0;  ///< For which it has kept back from a junction that its driver does not see.
  std::optional<Swerve> swerve;
  bool is_held = false;  ///< It could go, but what lies beyond its junction has no room for it.

  double length_m() const { return vehicle_models()[model].length_m; }
};

struct TownState {
  std::vector<TownVehicle> vehicles;
  double time_s = 0.0;
  std::vector<PersonCrossing> people;  ///< The caller's, of this tick: those at crossings, by crossing.
  std::vector<LimitedSight> sights;    ///< The caller's, of this tick.
  sight::OpticalDepth air;             ///< The same.
  std::vector<ViewOpening> openings;   ///< Of this tick.
  TownErrors errors;
  std::uint64_t claims = 0;              ///< Given so far.
  std::vector<double> foreign_stands_s;  ///< One a foreign vehicle.
  std::uint32_t bad_numbers = 0;
  ParticipantId next_id = 0;
};

/// Somebody of a swarm on a motorway as he drives in a town: closer. The share is the one with which a queue at a light
/// drives off as HCM has it (base saturation flow of 1,900 cars an hour and lane, start-up loss of 2 s).
Driver driver_in_town(const Driver& middle, double temperament);

TownState populate_town(const TrafficParameters& parameters, const road::RoadNetwork& network, const LaneGraph& graph,
                        std::span<const ForeignVehicle> foreign, Random& random);

void advance_town(const TrafficParameters& parameters, const road::RoadNetwork& network, const LaneGraph& graph,
                  std::span<const TrafficLight> lights, std::span<const ForeignVehicle> foreign, double dt_s,
                  Random& random, TownState& town);

/// Adds vehicles that come in as they find room, and worsens all drivers' manners by a step.
void worsen_town(TrafficParameters& parameters, const LaneGraph& graph, std::uint32_t more, Random& random,
                 TownState& town);

/// A driver overlooks another for one encounter (errors.hpp): `who` from now on; without him the next one who would have
/// to give way to `whom`. Error: there is no such vehicle, he errs already, or somebody is to overlook that one already.
Expected<void> overlook(std::optional<ParticipantId> who, ParticipantId whom, TownState& town);
/// Ends the errors of one who has touched somebody, and of those who overlook him.
void end_at_touch(ParticipantId id, TownState& town);

void append_participants(const LaneGraph& graph, const TownState& town, std::vector<Participant>& participants);

}  // namespace septet::traffic
