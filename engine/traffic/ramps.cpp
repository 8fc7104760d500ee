/// Leaving the motorway and coming back: a vehicle that takes an exit drives the ramp as a corridor of its own, at a
/// ramp's pace, and comes in again by the entry lane at its end, which it has to leave before that ends, as any lane
/// (MOBIL).

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/road/lane_links.hpp"
#include "engine/traffic/traffic_stages.hpp"

namespace septet::traffic {
namespace {

constexpr double ramp_speed_mps = 19.0;
constexpr double exit_announced_m = 1500.0;
constexpr double changing_s = 7.0;      ///< Longer than any driver's change of lane.
constexpr double exit_shown_m = 150.0;  ///< Reach of a change of lane into the ramp.

bool has_road(const Corridor& corridor, road::RoadIndex road) {
  return std::ranges::any_of(corridor.pieces, [&](const CorridorPiece& piece) { return piece.road == road; });
}

/// Continuations of `lane` of a piece at its far end.
std::vector<road::LaneContinuation> beyond(const road::RoadNetwork& network, const CorridorPiece& piece, int lane) {
  const auto& sections = network.roads[piece.road].sections;
  const std::size_t last = piece.along_s ? sections.size() - 1 : 0;
  if (!sections[last].has_lane(piece.side * lane)) return {};
  return road::continuations(network, piece.road, static_cast<std::uint32_t>(last), piece.side * lane, piece.along_s);
}

/// The chain of roads from an exit until it comes back to the corridor; empty where it does not, or where its lane's
/// number changes.
Corridor follow_ramp(const road::RoadNetwork& network, const Corridor& main, road::LaneContinuation at,
                     RampMouth& entry) {
  Corridor ramp;
  const int lane = std::abs(at.lane);
  for (std::size_t i = 0; i < network.roads.size() && std::abs(at.lane) == lane; ++i) {
    const double length = network.roads[at.road].length_m;
    ramp.pieces.push_back({at.road, at.towards_increasing_s, at.lane > 0 ? 1 : -1, ramp.length_m, length});
    ramp.length_m += length;
    const auto next = beyond(network, ramp.pieces.back(), lane);
    if (next.empty()) break;
    at = next.front();
    for (const CorridorPiece& piece : main.pieces) {
      if (piece.road != at.road) continue;
      entry = {piece.x_m, std::abs(at.lane)};
      return ramp;
    }
  }
  return {};
}

void add_ramps_of(const road::RoadNetwork& network, std::size_t main, TrafficState& state) {
  const Corridor corridor = state.corridors[main].corridor;
  for (const CorridorPiece& piece : corridor.pieces) {
    for (int lane = 1; lane <= state.corridors[main].table.highest; ++lane) {
      for (const auto& next : beyond(network, piece, lane)) {
        if (has_road(corridor, next.road)) continue;
        Ramp ramp{main, state.corridors.size(), {piece.x_m + piece.length_m, lane}, {}, std::abs(next.lane)};
        const Corridor chain = follow_ramp(network, corridor, next, ramp.entry);
        if (chain.pieces.empty()) continue;
        state.corridors.push_back(empty_corridor(network, chain));
        state.corridors[main].exits.push_back(ramp.exit);
        state.ramps.push_back(ramp);
      }
    }
  }
}

/// Visits each array of vehicles of `a` together with that of `b`.
template <class Visit>
void for_each_array(CorridorTraffic& a, CorridorTraffic& b, Visit visit) {
  visit(a.id, b.id), visit(a.model, b.model), visit(a.paint, b.paint);
  visit(a.driver, b.driver), visit(a.law, b.law);
  visit(a.x_m, b.x_m), visit(a.speed_mps, b.speed_mps);
  visit(a.acceleration_mps2, b.acceleration_mps2), visit(a.rolled_m, b.rolled_m);
  visit(a.lane, b.lane), visit(a.from_lane, b.from_lane), visit(a.change_part, b.change_part);
  visit(a.change_offset_m, b.change_offset_m), visit(a.change_run_m, b.change_run_m);
  visit(a.change_shortest_m, b.change_shortest_m);
  visit(a.next_decision_s, b.next_decision_s), visit(a.lane_end_m, b.lane_end_m);
  visit(a.length_m, b.length_m), visit(a.half_width_m, b.half_width_m);
  visit(a.aside_m, b.aside_m), visit(a.aside_mps, b.aside_mps);
  visit(a.aside_target_m, b.aside_target_m), visit(a.heard_s, b.heard_s);
  visit(a.making_way, b.making_way), visit(a.emergency, b.emergency);
  visit(a.neighbour_hints, b.neighbour_hints);
}

/// Moves a vehicle from one corridor's arrays to the end of another's, and out of its order.
void hand_arrays(CorridorTraffic& from, std::size_t i, CorridorTraffic& to) {
  const auto self = static_cast<std::int32_t>(i), last = static_cast<std::int32_t>(from.size()) - 1;
  for (auto& entries : from.order.lanes) {
    std::erase_if(entries, [&](const LaneEntry& entry) { return entry.vehicle == self; });
    for (LaneEntry& entry : entries)
      if (entry.vehicle == last) entry.vehicle = self;
  }
  for_each_array(from, to, [&](auto& source, auto& target) {
    target.push_back(source[i]);
    source[i] = source.back();
    source.pop_back();
  });
}

/// Moves a vehicle from one corridor to another, in `lane` at x. A change of lane goes on.
void hand_over(CorridorTraffic& from, std::size_t i, CorridorTraffic& to, int lane, double x_m) {
  hand_arrays(from, i, to);
  to.x_m.back() = x_m;
  to.lane.back() = to.from_lane.back() = static_cast<std::int16_t>(lane);
  to.lane_end_m.back() = lane_end_m(to.table, lane, std::max(x_m, 0.0));
  to.neighbour_hints.back() = {};
  to.any_aside = to.any_aside || to.aside_m.back() != 0.0;
  insert_entry(to.order.lanes[static_cast<std::size_t>(lane)], entry_of(to, to.size() - 1));
}

/// The entry of the last vehicle in `lane` from x on, shifted by `shift_m`; for the order of those who drive towards
/// it.
void show_last(const CorridorTraffic& traffic, int lane, double from_x_m, double shift_m, int shown_lane,
               ForeignTraffic& seen) {
  for (const LaneEntry& entry : traffic.order.lanes[static_cast<std::size_t>(lane)]) {
    if (entry.x_m < from_x_m || entry.vehicle < 0) continue;
    LaneEntry shown = entry;
    shown.x_m += shift_m;
    shown.vehicle = nobody_here;
    seen.entries.push_back({shown_lane, shown});
    return;
  }
}

/// A vehicle that took the exit during its change of lane still occupies the lane beside the exit's.
void show_unfinished(const CorridorTraffic& way, const Ramp& ramp, double lane_width_m, ForeignTraffic& seen) {
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (!changes_lane(way, i) || way.x_m[i] > exit_shown_m) continue;
    LaneEntry shown = entry_of(way, i);
    shown.x_m += ramp.exit.x_m;
    shown.lateral_m += static_cast<float>((ramp.lane - ramp.exit.lane) * lane_width_m);
    shown.vehicle = nobody_here;
    seen.entries.push_back({ramp.exit.lane - 1, shown});
  }
}

}  // namespace

void add_ramps(const road::RoadNetwork& network, TrafficState& state) {
  const std::size_t mains = state.corridors.size();
  for (std::size_t main = 0; main < mains; ++main) add_ramps_of(network, main, state);
}

const RampMouth* exit_ahead(const CorridorTraffic& traffic, std::size_t i, double exit_share) {
  // The intention to leave is a constant of the vehicle, not of the moment.
  const std::uint32_t mixed = traffic.id[i] * 2654435761u;
  if ((mixed >> 8) >= exit_share * (1u << 24)) return nullptr;
  for (const RampMouth& exit : traffic.exits) {
    const double ahead = exit.x_m - traffic.x_m[i];
    // A vehicle that could not finish the change of lane before the mouth drives on.
    const bool there = traffic.lane[i] == exit.lane;
    const double least = there ? 0.0 : changing_s * traffic.speed_mps[i];
    if (traffic.lane[i] <= exit.lane && ahead > least && ahead < exit_announced_m) return &exit;
  }
  return nullptr;
}

void show_across_mouths(const TrafficState& state, std::vector<ForeignTraffic>& seen) {
  for (const Ramp& ramp : state.ramps) {
    const CorridorTraffic &main = state.corridors[ramp.main], &way = state.corridors[ramp.way];
    const double length = way.corridor.length_m;
    show_last(way, ramp.lane, -1e3, ramp.exit.x_m, ramp.exit.lane, seen[ramp.main]);
    show_unfinished(way, ramp, main.table.lane_width_m, seen[ramp.main]);
    show_last(main, ramp.entry.lane, ramp.entry.x_m, length - ramp.entry.x_m, ramp.lane, seen[ramp.way]);
  }
}

bool remove_vehicle(ParticipantId id, TrafficState& state) {
  for (CorridorTraffic& traffic : state.corridors) {
    const auto found = std::ranges::find(traffic.id, id);
    if (found == traffic.id.end()) continue;
    CorridorTraffic nowhere;
    hand_arrays(traffic, static_cast<std::size_t>(found - traffic.id.begin()), nowhere);
    state.removed_below = std::max(state.removed_below, id + 1);
    return true;
  }
  return false;
}

void take_ramps(TrafficState& state) {
  for (const Ramp& ramp : state.ramps) {
    CorridorTraffic &main = state.corridors[ramp.main], &way = state.corridors[ramp.way];
    for (std::size_t i = 0; i < main.size();) {
      const bool leaves = main.lane[i] == ramp.exit.lane && rear_axle_x_m(main, i) >= ramp.exit.x_m &&
                          rear_axle_x_m(main, i) < ramp.exit.x_m + 20.0 && main.lane_end_m[i] == no_leader;
      if (!leaves) {
        ++i;
        continue;
      }
      hand_over(main, i, way, ramp.lane, main.x_m[i] - ramp.exit.x_m);
      FollowingParameters pace = way.driver.back().following;
      pace.desired_speed_mps = std::min(pace.desired_speed_mps, ramp_speed_mps);
      way.law.back() = FollowingLaw(pace);
    }
    const double length = way.corridor.length_m;
    for (std::size_t i = 0; i < way.size();) {
      if (rear_axle_x_m(way, i) < length) {
        ++i;
        continue;
      }
      hand_over(way, i, main, ramp.entry.lane, ramp.entry.x_m + way.x_m[i] - length);
      main.law.back() = FollowingLaw(main.driver.back().following);
    }
  }
}

}  // namespace septet::traffic
