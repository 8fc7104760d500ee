#pragma once
/// The stages of one tick of a town's traffic and their shared data. Used by engine/traffic/network only.

#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "engine/traffic/network/approach_view.hpp"
#include "engine/traffic/network/town.hpp"

namespace septet::traffic {

/// Somebody on a way, or on the way to it. Positions from the way's begin; a front below 0 has not reached it.
struct Presence {
  WayIndex way = no_way;
  std::int32_t who = 0;  ///< Index of a vehicle; −1 − k: foreign vehicle k.
  double front_m = 0.0, rear_m = 0.0;
  double speed_mps = 0.0;
  bool claims = false;     ///< It is within the junction, may enter it, or cannot stop before it.
  bool gives_way = false;  ///< It stands and does not use its right of way for now.

  bool is_there() const { return front_m > 0.0; }
};

/// All presences, by way.
struct Presences {
  std::vector<Presence> all;
  std::vector<std::uint32_t> first;  ///< By way; one more at the end.
  std::vector<HighBody> high;        ///< Foreign ones.

  std::span<const Presence> on(WayIndex way) const { return {all.data() + first[way], first[way + 1] - first[way]}; }
};

enum class LightState : std::uint8_t { dark, red, amber, green };

/// Lights by road and direction: 2·road, plus 1 where traffic runs against s.
std::vector<LightState> light_states(const road::RoadNetwork& network, std::span<const TrafficLight> lights);

/// How far a vehicle looks along its route, beyond its front.
inline constexpr double horizon_m = 130.0;
/// Gap at which vehicles stand, as room beyond a junction is reckoned.
inline constexpr double standing_gap_m = 2.5;

/// Time between one who leaves a conflict and the next who comes to it.
inline constexpr double behind_s = 0.4;

/// Length and speed of turning out round a body, and with that the room which it takes before one.
inline constexpr double swerve_m = 16.0, swerve_mps = 4.5, turn_out_m = swerve_m;

/// Distance to the left of its way that a swerve has at a place of the route, with its derivatives by the metre.
double aside_of(const Swerve& swerve, double at_m, double& slope, double& curvature_per_m);

/// Stage 2: begins and ends a vehicle's swerve. Returns the distance to where it waits for room beside what lies ahead;
/// infinite if there is nothing, or no way round it.
double round_wrecks(const road::RoadNetwork& network, const LaneGraph& graph, std::span<const ForeignVehicle> foreign,
                    const Presences& presences, TownState& town, std::size_t vehicle);

/// Adds the presence of a vehicle that swerves on the lane over which it does: as a body that stands.
void add_swerve(const LaneGraph& graph, const TownVehicle& vehicle, std::int32_t who, std::vector<Presence>& all);

/// Prolongs the route to the horizon, and to room beyond the last junction. Draws a random number at each fork.
void prolong_route(const LaneGraph& graph, Random& random, TownVehicle& vehicle);

/// Who has waited at a line for a minute, whatever for, draws another way there every 5 s: traffic may wait for each
/// other in a circle, as round a roundabout whose ways out are full, that only one who leaves it opens.
void choose_anew_if_tired(const LaneGraph& graph, double dt_s, Random& random, TownVehicle& vehicle);

/// Where a vehicle is at a place of its route, which goes straight on before its begin and beyond its end.
PlaceOnWay place_on_route(const LaneGraph& graph, const TownVehicle& vehicle, double route_m);

/// A vehicle's body on its route. A driver lets the long one swing out before a bend, so that it takes as much room to its
/// inside as to its outside: two points of its middle line keep to the route, each this share of its length from its centre.
/// On a circle the sagitta between them is then what its ends reach beyond the circle, which is where the root is from.
inline constexpr double guide_share = 0.5 * std::numbers::sqrt2 / 2.0;
struct BodyOnRoute {
  PlaceOnWay behind, ahead;      ///< Of the two points.
  Vec3 forwards{1.0, 0.0, 0.0};  ///< Unit, from one to the other.
  Vec3 rear_axle_m{0.0};         ///< Where it meets the road: the participant's position.
  double axle_share = 0.0;       ///< Of the rear axle between the points, from the one behind.
};
BodyOnRoute body_on_route(const LaneGraph& graph, const TownVehicle& vehicle);

/// Stage 1: everybody's presences. Keeps up standing times of foreign vehicles.
Presences find_presences(const road::RoadNetwork& network, const LaneGraph& graph,
                         std::span<const ForeignVehicle> foreign, double dt_s, TownState& town);

/// The nearest body ahead on the route, at most to the horizon.
struct Leader {
  double gap_m = no_leader;
  double speed_mps = 0.0;
  std::int32_t who = std::numeric_limits<std::int32_t>::min();
};
Leader leader_of(const LaneGraph& graph, const Presences& presences, const TownState& town, std::size_t vehicle);

/// A junction that a vehicle has before it: ways [first, last] of its route are those in it, and in all that come before
/// the first stretch beyond that holds it.
struct Passage {
  std::size_t first = 0, last = 0;
  double begin_m = 0.0;  ///< Of the first way, from the route's begin.
};

/// True where walls hide those who have right of way in a passage's first junction from a driver who has not come to its
/// line, `line_m` before him, yet.
bool walls_hide(const LaneGraph& graph, const TownVehicle& vehicle, const Passage& passage, double line_m);
/// The same of bodies, smoke and fog in this tick.
bool bodies_or_air_hide(const LaneGraph& graph, const Presences& presences, const TownState& town, std::size_t vehicle,
                        const Passage& passage, double line_m);

/// Stage 2: claims a vehicle's next junction if it is due, in view and free. Returns the distance from its front to the line at
/// which it is to stop; infinite if there is none.
double negotiate(const LaneGraph& graph, std::span<const LightState> lights, const Leader& leader, double dt_s,
                 Random& random, Presences& presences, TownState& town, std::size_t vehicle);

/// The distance of that line where nothing is claimed.
double stop_unclaimed_m(const LaneGraph& graph, const TownVehicle& vehicle);

/// Him whom a vehicle lets pass at the junction that it comes to, if it would claim it but for him, and he can still stop.
std::optional<std::int32_t> only_one_let_pass(const LaneGraph& graph, std::span<const LightState> lights,
                                              const Leader& leader, const Presences& presences, const TownState& town,
                                              std::size_t vehicle);

/// The light that a vehicle comes to, before the next junction that its front has not reached.
struct LightAhead {
  WayIndex way = no_way;  ///< The one that ends there.
  double line_m = 0.0;    ///< To its stop line; negative: the front has passed it.
};
std::optional<LightAhead> light_ahead(const LaneGraph& graph, const TownVehicle& vehicle);

/// Acceleration that keeps a vehicle out of what earlier claims within a junction hold, until they have left it; infinite
/// if there is none.
double wait_within_mps2(const LaneGraph& graph, const Presences& presences, TownState& town, std::size_t vehicle);

/// Those who are at one crossing.
std::span<const PersonCrossing> people_at(const TownState& town, std::uint32_t crossing);

/// Distance from a vehicle's front to the line at which it is to stop for people; infinite if there is none.
double stop_for_people_m(const LaneGraph& graph, const TownState& town, const TownVehicle& vehicle);

/// Acceleration before a place that is free after a time (infinite: never). Who can stop there by 2 m/s² later is free;
/// else it brakes evenly, so as to come to it when it is free, or to stand before it.
double acceleration_before(double stop_m, double free_in_s, double speed_mps);

/// Stage 3: acceleration behind a leader, before a stop, in bends and below limits, at most `within_mps2`.
double acceleration_of(const LaneGraph& graph, const TownVehicle& vehicle, const Leader& leader, double stop_m,
                       double within_mps2 = no_leader);

/// Stage 4: vehicles leave beyond the swarm's rim and come in again there.
void recycle_town(const TrafficParameters& parameters, const LaneGraph& graph, const Presences& presences,
                  const Vec3& middle_m, Random& random, TownState& town);

/// What a driver goes by in a tick.
struct Minded {
  Leader leader;
  double line_m = no_leader;       ///< As of `negotiate`.
  double within_mps2 = no_leader;  ///< As of `wait_within_mps2`.
};

/// What all stages of a tick are given.
struct TownTick {
  const LaneGraph& graph;
  std::span<const LightState> lights;
  std::span<const ForeignVehicle> foreign;
  double dt_s = 0.0;
};

/// Stage 2 of one who sees all others.
Minded mind_others(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t vehicle);

/// Stage 2 in a town where somebody errs, perhaps he: an error begins here where it is his occasion.
Minded mind_erring(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t vehicle);

/// Presences without one's.
Presences without(const Presences& presences, std::int32_t who);

/// Before stage 2: draws impulses to err, and ends errors and wishes.
void advance_errors(const TrafficParameters& parameters, const TownTick& tick, Random& random, TownState& town);

/// Time for a distance from a speed, with this acceleration up to the greatest speed.
double travel_s(double distance_m, double speed_mps, double acceleration_mps2, double most_mps);

}  // namespace septet::traffic
