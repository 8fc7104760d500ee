#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>

#include "engine/traffic/network/town_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double stop_mps2 = 2.0;    ///< Braking before a line.
constexpr double ahead_s = 1.5;      ///< Between one who has left a conflict and him who has right of way.
constexpr double patience_s = 3.0;   ///< Then somebody who stands before his own right of way is passed.
constexpr double courtesy_s = 25.0;  ///< Then those who can stop let him in.
constexpr double tired_s = 5.0;      ///< Each time another way is chosen, if what lies beyond this one is full.
constexpr double queues_mps = 5.0, looks_at_m = 1.5;  ///< Slower, and from there on, one out of a queue looks.
constexpr double starts_before_s = 0.5;    ///< Before one who crosses is there, whom it lets pass, somebody starts.
constexpr double reckoned_early_s = 0.15;  ///< Who comes is reckoned to speed up, so that gaps look shorter.
constexpr double rolls_mps = 1.0;          ///< Slower, one has stopped at a stop sign.
constexpr double at_line_m = 8.0, stands_mps = 0.5, stands_at_line_m = 2.0;

/// What a claim covers.
Passage passage_from(const LaneGraph& graph, const TownVehicle& vehicle, std::size_t first, double begin_m) {
  Passage passage{first, first, begin_m};
  double free_m = 0.0;
  for (std::size_t k = first; k < vehicle.route.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    if (way.in_junction())
      free_m = 0.0, passage.last = k;
    else
      free_m += way.length_m;
    if (free_m >= vehicle.length_m() + standing_gap_m) break;
  }
  return passage;
}

WayIndex way_of_front(const LaneGraph& graph, const TownVehicle& vehicle) {
  double end_m = 0.0;
  for (const WayIndex way : vehicle.route)
    if ((end_m += graph.ways[way].length_m) >= vehicle.front_m) return way;
  return vehicle.route.back();
}

/// True for one that comes behind it, on the way where its front is.
bool is_behind(std::span<const Presence> on_way, std::int32_t self, std::int32_t other) {
  const auto own = std::ranges::find(on_way, self, &Presence::who),
             his = std::ranges::find(on_way, other, &Presence::who);
  return own != on_way.end() && his != on_way.end() && his->front_m < own->front_m;
}

/// True where the rear of one who stands is within a junction of the passage: he would have it stand there as well.
bool stands_within(const LaneGraph& graph, const TownVehicle& vehicle, const Passage& passage, double rear_m) {
  double begin_m = passage.begin_m;
  for (std::size_t k = passage.first; k <= passage.last; ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    if (way.in_junction() && rear_m > begin_m && rear_m <= begin_m + way.length_m) return true;
    begin_m += way.length_m;
  }
  return false;
}

/// True where the vehicle can leave the junction: room beyond it for those who are in it on the way there, and for it.
bool has_room_beyond(const LaneGraph& graph, const Presences& presences, const TownVehicle& vehicle, std::int32_t self,
                     const Passage& passage) {
  const double needed_m = vehicle.length_m() + standing_gap_m;
  const auto here = presences.on(way_of_front(graph, vehicle));
  double room_m = 0.0, taken_m = 0.0;
  for (std::size_t k = passage.last + 1; k < vehicle.route.size() && room_m < 60.0; ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    // Nobody waits before the next junction of a roundabout but for somebody who does.
    const bool holds_nobody = way.in_junction() && !way.on_ring;
    double end_m = holds_nobody ? 0.0 : way.length_m;
    bool is_ended = holds_nobody;
    for (const Presence& presence : presences.on(vehicle.route[k])) {
      if (presence.who == self || is_behind(here, self, presence.who)) continue;
      const bool is_first = k == passage.last + 1;
      if (is_first && presence.rear_m < 0.0) {
        taken_m += presence.front_m - presence.rear_m + standing_gap_m;
        continue;
      }
      if (!presence.is_there()) continue;
      constexpr double leaves_mps2 = 6.0;  // It goes on at least for half of its own hard braking.
      const double until_m = std::max(0.0, presence.rear_m) + presence.speed_mps * presence.speed_mps / leaves_mps2;
      if (until_m < end_m) end_m = until_m, is_ended = true;
    }
    room_m += end_m;
    if (is_ended) break;
  }
  const bool ends_here = passage.last + 1 >= vehicle.route.size();
  return ends_here || room_m - taken_m >= needed_m;
}

/// Where a way lies on the passage, and the vehicle's speeds there.
struct Approach {
  const TownVehicle& vehicle;
  std::int32_t self = 0;
  double front_m = 0.0;  ///< Of the vehicle, from the way's begin.
  double most_mps = 0.0;
};

/// Time until a vehicle may have somebody behind it who comes along the way into which it turns: it is there by then, and he
/// brakes gently at most to its speed, to which it goes on gaining.
double merges_in_s(const Approach& approach, double to_begin_m, double his_mps) {
  constexpr double lets_in_mps2 = 2.0;
  const TownVehicle& vehicle = approach.vehicle;
  const double a = 0.8 * vehicle.driver.following.acceleration_mps2, v = vehicle.speed_mps;
  const double there_mps = std::min(std::sqrt(v * v + 2.0 * a * to_begin_m), std::max(v, approach.most_mps));
  const double closing_mps = std::max(0.0, his_mps - there_mps);
  const double behind_m = vehicle.length_m() + standing_gap_m + closing_mps * closing_mps / (2.0 * (lets_in_mps2 + a));
  return travel_s(to_begin_m, v, a, approach.most_mps) + behind_m / std::max(his_mps, 1.0);
}

/// True where this presence on the other way of a conflict leaves the vehicle free to go.
bool lets_go(const LaneGraph& graph, const Approach& approach, const Way& mine, const WayConflict& conflict,
             const Presence& other, bool has_green) {
  const TownVehicle& vehicle = approach.vehicle;
  const Way& his = graph.ways[conflict.with];
  if (other.rear_m > conflict.with_whole_to_m) return true;
  const double a = vehicle.driver.following.acceleration_mps2;
  const double to_begin_m = std::max(0.0, conflict.whole_from_m - approach.front_m);
  const double his_most = most_mps_on(his);
  if (other.claims) {
    if (other.who < 0 && other.speed_mps < stands_mps) return false;  // Nobody knows when it goes on.
    if (conflict.kind == WayConflict::Kind::merging && other.is_there()) {
      // Who is ahead of it on the way out is its leader.
      const double behind_m =
          (mine.length_m + mine.to_exit_m - approach.front_m) - (his.length_m + his.to_exit_m - other.front_m);
      if (behind_m > 3.0 && other.speed_mps > 1.0) return true;
    }
    // Nobody starts across before one who is not there yet.
    const double soon_m = conflict.with_whole_from_m - other.front_m;
    if (conflict.kind == WayConflict::Kind::crossing && mine.rank == Rank::yields && vehicle.speed_mps < queues_mps &&
        soon_m > starts_before_s * other.speed_mps)
      return false;
    const double arrives_s = travel_s(to_begin_m, vehicle.speed_mps, a, approach.most_mps);
    const double clears_s = travel_s(conflict.with_whole_to_m - other.rear_m, other.speed_mps, 1.0, his_most);
    return arrives_s > clears_s + behind_s;
  }
  if (!yields_to(mine, his)) return true;
  if (other.gives_way && vehicle.waits_s > patience_s * vehicle.urge) return true;
  const double to_line_m = -other.front_m;
  const bool can_stop = other.speed_mps * other.speed_mps < 2.0 * stop_mps2 * to_line_m || other.speed_mps < stands_mps;
  if (vehicle.waits_s > courtesy_s * vehicle.urge && can_stop && !has_green) return true;
  if (has_green && vehicle.waits_s > 2.0 * courtesy_s * vehicle.urge && can_stop) return true;
  const bool merges = conflict.kind == WayConflict::Kind::merging;
  const double clears_s = merges ? merges_in_s(approach, to_begin_m, std::max(other.speed_mps, his_most))
                                 : travel_s(conflict.whole_to_m - approach.front_m + vehicle.length_m(),
                                            vehicle.speed_mps, 0.8 * a, approach.most_mps);
  const double his_arrives_s = travel_s(conflict.with_whole_from_m - other.front_m, other.speed_mps, 1.5, his_most);
  double needed_s = merges ? clears_s : clears_s + ahead_s * vehicle.urge;
  if (vehicle.speed_mps < 3.0) needed_s = std::max(needed_s, (critical_gap_s(mine) - reckoned_early_s) * vehicle.urge);
  return his_arrives_s > needed_s;
}

/// A long one that holds a way beside, past which another long one does not fit. It is waited for until it has left.
const Presence* long_one_beside(const LaneGraph& graph, const Presences& presences, const Way& way) {
  for (const WayIndex beside : graph.long_conflicts_of(way))
    for (const Presence& other : presences.on(beside))
      if (other.claims && other.front_m - other.rear_m > long_vehicle_m) return &other;
  return nullptr;
}

/// The first one found who keeps a vehicle from its passage; null: it is free.
const Presence* in_the_way(const LaneGraph& graph, const Presences& presences, const TownVehicle& vehicle,
                           std::int32_t self, const Passage& passage, bool has_green) {
  double begin_m = passage.begin_m;
  for (std::size_t k = passage.first; k <= passage.last; ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    const Approach approach{vehicle, self, vehicle.front_m - begin_m, most_mps_on(way)};
    begin_m += way.length_m;
    for (const Presence& other : presences.on(vehicle.route[k])) {
      // On a way between two junctions too short to stop on, or one who comes in from elsewhere.
      if (other.who != self && other.is_there() && !other.claims) return &other;
    }
    if (vehicle.length_m() > long_vehicle_m)
      if (const Presence* beside = long_one_beside(graph, presences, way)) return beside;
    for (const WayConflict& conflict : graph.conflicts_of(way)) {
      if (conflict.kind == WayConflict::Kind::diverging) continue;
      for (const Presence& other : presences.on(conflict.with))
        if (other.who != self && !lets_go(graph, approach, way, conflict, other, has_green)) return &other;
    }
  }
  return nullptr;
}

/// Index in its route of the first way of a junction that a vehicle has not reached; the route's size if there is none.
std::size_t next_entry(const LaneGraph& graph, const TownVehicle& vehicle) {
  double begin_m = 0.0;
  for (std::size_t k = 0; k < vehicle.route.size(); ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    if (begin_m >= vehicle.front_m && way.in_junction()) return k;
    begin_m += way.length_m;
  }
  return vehicle.route.size();
}

/// True where a vehicle waits to drive a way: it is in the passage that it is to claim next.
bool waits_to_drive(const LaneGraph& graph, const TownVehicle& vehicle, WayIndex way) {
  const std::size_t entry = next_entry(graph, vehicle);
  if (entry >= vehicle.route.size()) return false;
  const std::size_t last = passage_from(graph, vehicle, entry, 0.0).last;
  const auto passage = std::span(vehicle.route).subspan(entry, last - entry + 1);
  return std::ranges::find(passage, way) != passage.end();
}

/// True where somebody who comes to the same exit by another way has long waited for room on it: it is his turn.
bool is_anothers_turn(const LaneGraph& graph, const Presences& presences, const TownState& town,
                      const TownVehicle& vehicle, const Passage& passage) {
  for (std::size_t k = passage.first; k <= passage.last; ++k)
    for (const WayConflict& conflict : graph.conflicts_of(graph.ways[vehicle.route[k]])) {
      if (conflict.kind != WayConflict::Kind::merging) continue;
      for (const Presence& other : presences.on(conflict.with)) {
        if (other.who < 0 || other.claims) continue;
        const TownVehicle& rival = town.vehicles[static_cast<std::size_t>(other.who)];
        // Who waits for this vehicle to go on is no rival.
        const bool waits_for_it = std::ranges::find(rival.route, way_of_front(graph, vehicle)) != rival.route.end();
        // Nor is one who waits at a junction before this one: those ahead of it may wait for this vehicle.
        if (!waits_for_it && rival.is_held && rival.waits_s > std::max(courtesy_s * rival.urge, vehicle.waits_s) &&
            waits_to_drive(graph, rival, conflict.with))
          return true;
      }
    }
  return false;
}

/// Tells that a driver has come to see a junction that was hidden.
void see_junction(double line_m, TownState& town, TownVehicle& vehicle) {
  if (const double hidden_s = std::exchange(vehicle.hidden_s, 0.0); hidden_s > 0.0)
    town.openings.push_back({vehicle.id, line_m, hidden_s});
}

LightState light_before(std::span<const LightState> lights, const Way& way) {
  return lights.empty() || !way.has_light ? LightState::dark : lights[2 * way.road + (way.along_s ? 0 : 1)];
}

/// True where a vehicle stops before the line of a light that has turned to amber; else it goes on.
bool stops_at_amber(const TownVehicle& vehicle, double to_line_m) {
  constexpr double amber_mps2 = 3.0;  // As much as has_room_beyond reckons with: who counts on its going on has room.
  return vehicle.speed_mps * vehicle.speed_mps <= 2.0 * amber_mps2 * std::max(to_line_m, 0.0);
}

bool light_allows(LightState light, const TownVehicle& vehicle, double to_line_m) {
  if (light == LightState::red) return false;
  return light != LightState::amber || !stops_at_amber(vehicle, to_line_m);
}

/// Who came to his claim at green stops at a light that has turned since, where he can; not where the junction that he is
/// in leaves him no room before it.
void give_back_at_light(const LaneGraph& graph, std::span<const LightState> lights, TownVehicle& vehicle) {
  const std::size_t entry = lights.empty() ? 0 : next_entry(graph, vehicle);
  if (entry == 0 || entry >= vehicle.claims.size()) return;
  const Way& before = graph.ways[vehicle.route[entry - 1]];
  const LightState light = light_before(lights, before);
  if (light != LightState::amber && light != LightState::red) return;
  double to_line_m = -vehicle.front_m - before.line_before_m;
  for (std::size_t k = 0; k < entry; ++k) {
    const Way& way = graph.ways[vehicle.route[k]];
    if (way.in_junction() && passage_from(graph, vehicle, k, 0.0).last >= entry) return;
    to_line_m += way.length_m;
  }
  if (to_line_m > 0.0 && stops_at_amber(vehicle, to_line_m)) vehicle.claims.resize(entry);
}

/// True where somebody else has a claim on the way on which a vehicle's front is: he counts on its going on.
bool is_counted_on(const LaneGraph& graph, const Presences& presences, const TownVehicle& vehicle, std::int32_t self) {
  return std::ranges::any_of(presences.on(way_of_front(graph, vehicle)),
                             [&](const Presence& other) { return other.who != self && other.claims; });
}

/// Gives a claim back that is of no use: before its junction, all of it outside of any, it stands behind somebody.
void give_back_if_unused(const LaneGraph& graph, const Presences& presences, std::int32_t self, double dt_s,
                         TownVehicle& vehicle) {
  constexpr double unused_s = 4.0;
  vehicle.unused_s = vehicle.speed_mps < stands_mps ? vehicle.unused_s + dt_s : 0.0;
  if (vehicle.claims.empty() || vehicle.unused_s < unused_s) return;
  const std::size_t entry = next_entry(graph, vehicle);
  if (entry >= vehicle.claims.size()) return;
  for (std::size_t k = 0; k < entry; ++k)
    if (graph.ways[vehicle.route[k]].in_junction()) return;
  if (!is_counted_on(graph, presences, vehicle, self)) vehicle.claims.clear();
}

/// The junction that a vehicle is to claim next, once it has come so near that it would brake for its line.
struct NextClaim {
  std::size_t first = 0;  ///< Of its ways, in the route.
  double begin_m = 0.0;   ///< Of that way, from the route's begin.
  double line_m = 0.0;    ///< To the stop line, and to where the vehicle stops.
  double stop_m = 0.0;
};

std::optional<NextClaim> next_claim(const LaneGraph& graph, const TownVehicle& vehicle) {
  NextClaim next;
  for (; next.first < vehicle.route.size(); ++next.first) {
    const Way& way = graph.ways[vehicle.route[next.first]];
    if (next.begin_m >= vehicle.front_m && next.first >= vehicle.claims.size() && way.in_junction()) break;
    next.begin_m += way.length_m;
  }
  if (next.first >= vehicle.route.size() || next.first == 0) return std::nullopt;
  const Way& before = graph.ways[vehicle.route[next.first - 1]];
  next.line_m = next.begin_m - vehicle.front_m - (before.in_junction() ? 0.0 : before.line_before_m);
  const double v = vehicle.speed_mps;
  if (next.line_m > v * v / (2.0 * stop_mps2) + 0.7 * v + 6.0) return std::nullopt;
  next.stop_m = std::max(next.line_m, std::min(0.0, next.begin_m - vehicle.front_m));
  return next;
}

/// True where a vehicle goes on to its line before it claims: at a stop sign everybody stands there, unless lights are
/// lit; out of a queue one looks from the line, and only then goes on.
bool goes_to_line_first(const LaneGraph& graph, LightState light, const TownVehicle& vehicle, const NextClaim& next) {
  if (light != LightState::dark) return false;
  const double v = vehicle.speed_mps;
  const Way& before = graph.ways[vehicle.route[next.first - 1]];
  const Way& entry = graph.ways[vehicle.route[next.first]];
  if (before.has_stop && (v >= rolls_mps || next.line_m > stands_at_line_m)) return true;
  const bool looks_at_line = entry.rank == Rank::yields && !entry.onto_ring && !entry.on_ring;
  return looks_at_line && v < queues_mps && next.line_m > looks_at_m;
}

/// True where a vehicle is not the first before the line: behind somebody who waits himself it is not its turn.
bool is_behind_another(const LaneGraph& graph, const Leader& leader, const TownState& town, double line_m) {
  if (leader.who < 0) return leader.gap_m < line_m;
  const TownVehicle& ahead = town.vehicles[static_cast<std::size_t>(leader.who)];
  return leader.gap_m + ahead.length_m() < line_m && next_entry(graph, ahead) >= ahead.claims.size();
}

/// Others see the claim in the same tick.
void show_claim(const TownVehicle& vehicle, std::int32_t self, const Passage& passage, Presences& presences) {
  for (std::size_t k = passage.first; k <= passage.last; ++k) {
    const WayIndex way = vehicle.route[k];
    for (std::uint32_t p = presences.first[way]; p < presences.first[way + 1]; ++p)
      if (presences.all[p].who == self) presences.all[p].claims = true;
  }
}

}  // namespace

std::vector<LightState> light_states(const road::RoadNetwork& network, std::span<const TrafficLight> lights) {
  std::vector<LightState> states(lights.empty() ? 0 : 2 * network.roads.size(), LightState::dark);
  for (const TrafficLight& light : lights) {
    if (light.for_walkers || light.road >= network.roads.size()) continue;
    LightState& state = states[2 * light.road + (light.along_s ? 0 : 1)];
    const LightState shown = light.lamps.has(Lamp::signal_red)     ? LightState::red
                             : light.lamps.has(Lamp::signal_amber) ? LightState::amber
                             : light.lamps.has(Lamp::signal_green) ? LightState::green
                                                                   : LightState::dark;
    // Of several heads the most restrictive one holds.
    if (state == LightState::dark || (shown != LightState::dark && shown < state)) state = shown;
  }
  return states;
}

double travel_s(double distance_m, double speed_mps, double acceleration_mps2, double most_mps) {
  if (distance_m <= 0.0) return 0.0;
  const double most = std::max(most_mps, 1.0), from = std::min(speed_mps, most);
  const double gains_s = (most - from) / acceleration_mps2;
  const double gains_m = 0.5 * (from + most) * gains_s;
  if (gains_m >= distance_m)
    return (std::sqrt(from * from + 2.0 * acceleration_mps2 * distance_m) - from) / acceleration_mps2;
  return gains_s + (distance_m - gains_m) / most;
}

double negotiate(const LaneGraph& graph, std::span<const LightState> lights, const Leader& leader, double dt_s,
                 Random& random, Presences& presences, TownState& town, std::size_t index) {
  TownVehicle& vehicle = town.vehicles[index];
  const auto self = static_cast<std::int32_t>(index);
  give_back_if_unused(graph, presences, self, dt_s, vehicle);
  give_back_at_light(graph, lights, vehicle);
  vehicle.is_held = false;
  const std::optional<NextClaim> next = next_claim(graph, vehicle);
  if (!next) return no_leader;
  const double line_m = next->line_m, stop_m = next->stop_m;
  const bool waits = vehicle.speed_mps < stands_mps && line_m < at_line_m;
  vehicle.waits_s = waits ? vehicle.waits_s + dt_s : 0.0;
  if (is_behind_another(graph, leader, town, line_m)) return stop_m;

  const LightState light = light_before(lights, graph.ways[vehicle.route[next->first - 1]]);
  if (!light_allows(light, vehicle, line_m)) return stop_m;
  if (goes_to_line_first(graph, light, vehicle, *next)) return stop_m;
  const Passage passage = passage_from(graph, vehicle, next->first, next->begin_m);
  // Who has green gives way to the oncoming alone, whom he has before him.
  const bool looks = light != LightState::green && light != LightState::amber;
  if (looks && walls_hide(graph, vehicle, passage, line_m)) {
    vehicle.hidden_s += dt_s;
    return stop_m;
  }
  if (leader.speed_mps < stands_mps && stands_within(graph, vehicle, passage, vehicle.front_m + leader.gap_m))
    return stop_m;
  if (!has_room_beyond(graph, presences, vehicle, self, passage)) {
    vehicle.is_held = true;
    const double waited_s = std::max(0.0, vehicle.waits_s - dt_s);
    if (std::floor(vehicle.waits_s / tired_s) > std::floor(waited_s / tired_s)) {
      vehicle.route.resize(next->first);
      prolong_route(graph, random, vehicle);
    }
    return stop_m;
  }
  if (is_anothers_turn(graph, presences, town, vehicle, passage) ||
      in_the_way(graph, presences, vehicle, self, passage, light == LightState::green) != nullptr) {
    see_junction(line_m, town, vehicle);
    return stop_m;
  }
  if (looks && bodies_or_air_hide(graph, presences, town, index, passage, line_m)) {
    vehicle.hidden_s += dt_s;
    return stop_m;
  }
  see_junction(line_m, town, vehicle);
  vehicle.claims.resize(passage.last + 1, ++town.claims);
  vehicle.waits_s = vehicle.unused_s = 0.0;
  show_claim(vehicle, self, passage, presences);
  return no_leader;
}

double stop_unclaimed_m(const LaneGraph& graph, const TownVehicle& vehicle) {
  const std::optional<NextClaim> next = next_claim(graph, vehicle);
  return next ? next->stop_m : no_leader;
}

std::optional<std::int32_t> only_one_let_pass(const LaneGraph& graph, std::span<const LightState> lights,
                                              const Leader& leader, const Presences& presences, const TownState& town,
                                              std::size_t index) {
  const TownVehicle& vehicle = town.vehicles[index];
  const auto self = static_cast<std::int32_t>(index);
  const std::optional<NextClaim> next = next_claim(graph, vehicle);
  if (!next || is_behind_another(graph, leader, town, next->line_m)) return std::nullopt;
  const LightState light = light_before(lights, graph.ways[vehicle.route[next->first - 1]]);
  if (!light_allows(light, vehicle, next->line_m) || goes_to_line_first(graph, light, vehicle, *next))
    return std::nullopt;
  const Passage passage = passage_from(graph, vehicle, next->first, next->begin_m);
  const bool has_green = light == LightState::green;
  if (!has_green && walls_hide(graph, vehicle, passage, next->line_m)) return std::nullopt;
  if (!has_room_beyond(graph, presences, vehicle, self, passage)) return std::nullopt;
  const Presence* first = in_the_way(graph, presences, vehicle, self, passage, has_green);
  if (first == nullptr || first->claims || first->is_there()) return std::nullopt;
  const Presences others = without(presences, first->who);
  if (in_the_way(graph, others, vehicle, self, passage, has_green) != nullptr) return std::nullopt;
  return first->who;
}

std::optional<LightAhead> light_ahead(const LaneGraph& graph, const TownVehicle& vehicle) {
  const std::size_t entry = next_entry(graph, vehicle);
  if (entry == 0 || entry >= vehicle.route.size()) return std::nullopt;
  LightAhead ahead{vehicle.route[entry - 1], -vehicle.front_m};
  const Way& before = graph.ways[ahead.way];
  if (!before.has_light) return std::nullopt;
  for (std::size_t k = 0; k < entry; ++k) ahead.line_m += graph.ways[vehicle.route[k]].length_m;
  ahead.line_m -= before.line_before_m;
  return ahead;
}

}  // namespace septet::traffic
