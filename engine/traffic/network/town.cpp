#include "engine/traffic/network/town.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "engine/traffic/looks.hpp"
#include "engine/traffic/network/town_stages.hpp"
#include "engine/world/indicator.hpp"

namespace septet::traffic {
namespace {

/// Speed and place a tick on; ways that its rear has left leave the route.
void move(const LaneGraph& graph, double dt_s, TownVehicle& vehicle) {
  const double before = vehicle.speed_mps;
  double after = before + vehicle.acceleration_mps2 * dt_s, way_m = 0.5 * (before + after) * dt_s;
  if (after < 0.0) {
    way_m = vehicle.acceleration_mps2 < 0.0 ? -0.5 * before * before / vehicle.acceleration_mps2 : 0.0;
    after = 0.0;
    vehicle.acceleration_mps2 = -before / dt_s;
  }
  vehicle.speed_mps = after;
  vehicle.front_m += way_m;
  vehicle.rolled_m += way_m;
  constexpr double walking_mps = 0.5;
  vehicle.stands_s = after < walking_mps ? vehicle.stands_s + dt_s : 0.0;
  while (vehicle.route.size() > 1) {
    const double length_m = graph.ways[vehicle.route.front()].length_m;
    if (vehicle.front_m - vehicle.length_m() < length_m) break;
    vehicle.front_m -= length_m;
    if (vehicle.swerve) vehicle.swerve->from_m -= length_m, vehicle.swerve->to_m -= length_m;
    vehicle.route.erase(vehicle.route.begin());
    if (!vehicle.claims.empty()) vehicle.claims.erase(vehicle.claims.begin());
  }
}

void put_aside(const Swerve& swerve, double at_m, PlaceOnWay& place) {
  double slope = 0.0, curvature_per_m = 0.0;
  const double left_m = aside_of(swerve, at_m, slope, curvature_per_m);
  const Vec3 left = glm::normalize(Vec3(-place.tangent.y, place.tangent.x, 0.0));
  place.position_m += left_m * left;
  place.tangent = glm::normalize(place.tangent + slope * left);
  place.curvature_per_m += curvature_per_m;
}

/// 1: it turns left at the junction that it is in or comes to, or turns out to the left; −1: right.
int indicated_turn(const LaneGraph& graph, const TownVehicle& vehicle) {
  if (vehicle.swerve && vehicle.front_m < vehicle.swerve->from_m) return vehicle.swerve->left_m > 0.0 ? 1 : -1;
  constexpr double before_m = 40.0, turning_rad = 0.5;
  double begin_m = 0.0;
  for (const WayIndex index : vehicle.route) {
    const Way& way = graph.ways[index];
    if (begin_m > vehicle.front_m + before_m) break;
    begin_m += way.length_m;
    if (!way.in_junction() || begin_m < vehicle.front_m - vehicle.length_m()) continue;
    return way.turns_rad > turning_rad ? 1 : way.turns_rad < -turning_rad ? -1 : 0;
  }
  return 0;
}

void show_vehicle(const LaneGraph& graph, const TownVehicle& vehicle, double time_s, Participant& participant) {
  const VehicleModel& model = vehicle_models()[vehicle.model];
  const BodyOnRoute body = body_on_route(graph, vehicle);
  const PlaceOnWay &behind = body.behind, &ahead = body.ahead;
  const Vec3& forwards = body.forwards;
  const double heading = std::atan2(forwards.y, forwards.x);
  const double v = vehicle.speed_mps;
  participant.id = vehicle.id;
  participant.model = look_of(vehicle.model, vehicle.id);
  participant.paint = vehicle.paint;
  participant.world_from_vehicle = {
      body.rear_axle_m,
      orientation_from_angles(heading, -std::atan2(forwards.z, std::hypot(forwards.x, forwards.y)), 0.0)};
  // A rigid body's motion is linear between two of its points.
  const auto at_axle = [&](const Vec3& there, const Vec3& here) { return there + body.axle_share * (here - there); };
  const auto acceleration_of = [&](const PlaceOnWay& place) {
    const Vec3 left(-place.tangent.y, place.tangent.x, 0.0);
    return vehicle.acceleration_mps2 * place.tangent + v * v * place.curvature_per_m * left;
  };
  participant.velocity_mps = v * at_axle(behind.tangent, ahead.tangent);
  participant.acceleration_mps2 = at_axle(acceleration_of(behind), acceleration_of(ahead));
  const Vec3 turned = ahead.tangent - behind.tangent;
  participant.angular_velocity_radps.z =
      v * (forwards.x * turned.y - forwards.y * turned.x) / (2.0 * guide_share * model.length_m);
  participant.front_steer_rad = std::atan2(forwards.x * ahead.tangent.y - forwards.y * ahead.tangent.x,
                                           forwards.x * ahead.tangent.x + forwards.y * ahead.tangent.y);
  constexpr double turn_rad = 2.0 * std::numbers::pi;
  const double turns = vehicle.rolled_m / model.wheel_radius_m / turn_rad;
  participant.wheel_spin_rad = (turns - std::floor(turns)) * turn_rad;
  participant.wheel_spin_radps = v / model.wheel_radius_m;
  participant.lamps.set(Lamp::low_beam, true);
  participant.lamps.set(Lamp::brake, vehicle.acceleration_mps2 < -0.7 || v < 0.1);
  const int side = indicated_turn(graph, vehicle);
  if (side != 0 && indicator_is_lit(time_s, vehicle.id))
    participant.lamps.set(side > 0 ? Lamp::indicator_left : Lamp::indicator_right, true);
}

}  // namespace

BodyOnRoute body_on_route(const LaneGraph& graph, const TownVehicle& vehicle) {
  const VehicleModel& model = vehicle_models()[vehicle.model];
  const double guide_m = guide_share * model.length_m, centre_m = vehicle.front_m - 0.5 * model.length_m;
  BodyOnRoute body;
  body.behind = place_on_route(graph, vehicle, centre_m - guide_m);
  body.ahead = place_on_route(graph, vehicle, centre_m + guide_m);
  const Vec3 apart = body.ahead.position_m - body.behind.position_m;
  const double apart_m = glm::length(apart);
  body.forwards = apart_m > 0.1 ? apart / apart_m : body.behind.tangent;
  body.rear_axle_m = 0.5 * (body.ahead.position_m + body.behind.position_m) - model.centre_x_m() * body.forwards;
  body.axle_share = 0.5 * (1.0 - model.centre_x_m() / guide_m);
  return body;
}

PlaceOnWay place_on_route(const LaneGraph& graph, const TownVehicle& vehicle, double route_m) {
  double at_m = route_m;
  for (std::size_t k = 0;; ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    if (at_m <= way.length_m || k + 1 == vehicle.route.size()) {
      PlaceOnWay place = place_on_way(graph, way, at_m);
      // Before its begin and beyond its end a way goes straight on.
      const double beyond_m = at_m < 0.0 ? at_m : std::max(0.0, at_m - way.length_m);
      place.position_m += beyond_m * place.tangent;
      if (vehicle.swerve) put_aside(*vehicle.swerve, route_m, place);
      return place;
    }
    at_m -= way.length_m;
  }
}

Minded mind_others(const TownTick& tick, Random& random, Presences& presences, TownState& town, std::size_t index) {
  Minded minded;
  minded.leader = leader_of(tick.graph, presences, town, index);
  minded.line_m = negotiate(tick.graph, tick.lights, minded.leader, tick.dt_s, random, presences, town, index);
  minded.within_mps2 = wait_within_mps2(tick.graph, presences, town, index);
  return minded;
}

void advance_town(const TrafficParameters& parameters, const road::RoadNetwork& network, const LaneGraph& graph,
                  std::span<const TrafficLight> lights, std::span<const ForeignVehicle> foreign, double dt_s,
                  Random& random, TownState& town) {
  const double before_s = town.time_s;
  town.time_s += dt_s;
  town.openings.clear();
  for (TownVehicle& vehicle : town.vehicles)
    if (!vehicle.outside) {
      choose_anew_if_tired(graph, dt_s, random, vehicle);
      prolong_route(graph, random, vehicle);
    }
  Presences presences = find_presences(network, graph, foreign, dt_s, town);
  const std::vector<LightState> shown = light_states(network, lights);
  const TownTick tick{graph, shown, foreign, dt_s};
  advance_errors(parameters, tick, random, town);
  const bool any_adrift = std::ranges::any_of(foreign, &ForeignVehicle::adrift);
  for (std::size_t i = 0; i < town.vehicles.size(); ++i) {
    TownVehicle& vehicle = town.vehicles[i];
    if (vehicle.outside) continue;
    const double turn_out_at_m = any_adrift ? round_wrecks(network, graph, foreign, presences, town, i) : no_leader;
    const Minded minded = town.errors.any() ? mind_erring(tick, random, presences, town, i)
                                            : mind_others(tick, random, presences, town, i);
    double a = acceleration_of(graph, vehicle, minded.leader,
                               std::min({minded.line_m, turn_out_at_m, stop_for_people_m(graph, town, vehicle)}),
                               minded.within_mps2);
    if (const auto sight = std::ranges::find(town.sights, vehicle.id, &LimitedSight::driver);
        sight != town.sights.end())
      a = std::min(a, acceleration_within_sight(vehicle.driver.following, vehicle.speed_mps, sight->seen_m));
    if (!std::isfinite(a)) a = 0.0, ++town.bad_numbers;
    vehicle.acceleration_mps2 = a;
  }
  for (TownVehicle& vehicle : town.vehicles)
    if (!vehicle.outside) move(graph, dt_s, vehicle);
  constexpr double recycle_interval_s = 0.5;
  if (std::floor(before_s / recycle_interval_s) == std::floor(town.time_s / recycle_interval_s)) return;
  const Vec3 middle_m = foreign.empty() ? Vec3(0.5 * (network.low_m + network.high_m), 0.0)
                                        : foreign.front().world_from_vehicle.position_m;
  recycle_town(parameters, graph, presences, middle_m, random, town);
}

void append_participants(const LaneGraph& graph, const TownState& town, std::vector<Participant>& participants) {
  for (const TownVehicle& vehicle : town.vehicles)
    if (!vehicle.outside) show_vehicle(graph, vehicle, town.time_s, participants.emplace_back());
}

}  // namespace septet::traffic
