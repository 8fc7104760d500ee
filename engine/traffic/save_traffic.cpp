#include "engine/traffic/save_traffic.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/position_members.hpp"
#include "engine/traffic/driver_members.hpp"

namespace septet::traffic {

SEPTET_MEMBERS(LaneEntry, x_m, speed_mps, length_m, acceleration_mps2, lateral_m, half_width_m, vehicle, straddles)
SEPTET_MEMBERS(LaneOrder, lanes, has_straddlers)
SEPTET_MEMBERS(RampMouth, x_m, lane)
SEPTET_MEMBERS(Ramp, main, way, exit, entry, lane)

// Left out are the corridor and its tables of road data. Kept are a vehicle's constants, drawn when it came in, and
// data that follows from the hashed or is searched from it.
SEPTET_MEMBER_GROUPS(CorridorTraffic, left_out(corridor, table, line, ways), hashed(id),
                     kept(model, paint, driver, law), hashed(x_m, speed_mps, acceleration_mps2), kept(rolled_m),
                     hashed(lane, from_lane, change_part, change_offset_m, change_run_m), kept(change_shortest_m),
                     hashed(next_decision_s), kept(lane_end_m, length_m, half_width_m),
                     hashed(aside_m, aside_mps, aside_target_m, heard_s, making_way, emergency),
                     kept(neighbour_hints, any_aside, order, exits))
// The corridors are taken one by one. Sights are given anew each tick.
SEPTET_MEMBER_GROUPS(TrafficState, left_out(corridors), kept(ramps), hashed(time_s), left_out(sights),
                     kept(foreign_places), hashed(foreign_speeds_mps, foreign_stands_s, foreign_signals_s, bad_numbers),
                     kept(removed_below))

namespace {

/// A corridor is saved as the list of its roads.
struct RoadOfCorridor {
  road::RoadIndex road = 0;
  bool along_s = true, on_the_left = false;
};
SEPTET_MEMBERS(RoadOfCorridor, road, along_s, on_the_left)
struct RoadsOfCorridor {
  std::vector<RoadOfCorridor> roads;
  bool closed = false;
};
SEPTET_MEMBERS(RoadsOfCorridor, roads, closed)

RoadsOfCorridor roads_of(const Corridor& corridor) {
  RoadsOfCorridor kept;
  for (const CorridorPiece& piece : corridor.pieces) kept.roads.push_back({piece.road, piece.along_s, piece.side > 0});
  kept.closed = corridor.closed;
  return kept;
}

Corridor corridor_of(const road::RoadNetwork& network, const RoadsOfCorridor& kept, StateReader& reader) {
  Corridor corridor;
  corridor.closed = kept.closed;
  reader.require(!kept.roads.empty() && kept.roads.size() <= network.roads.size(), "traffic in it has other roads");
  for (const RoadOfCorridor& piece : kept.roads) {
    if (!reader.require(piece.road < network.roads.size(), "traffic in it is on no road")) break;
    const double length_m = network.roads[piece.road].length_m;
    corridor.pieces.push_back({piece.road, piece.along_s, piece.on_the_left ? 1 : -1, corridor.length_m, length_m});
    corridor.length_m += length_m;
  }
  return corridor;
}

/// Requires every index within its range, every place within reach of the corridor.
void require_whole(const CorridorTraffic& traffic, StateReader& reader) {
  const std::size_t count = traffic.size(), lanes = traffic.table.open.size();
  constexpr auto wrong = "traffic in it does not fit together";
  // Every array but that of the exits has one entry a vehicle.
  const auto require_count = [&](const auto& array) {
    if constexpr (archive::is_vector<std::remove_cvref_t<decltype(array)>>)
      if (static_cast<const void*>(&array) != &traffic.exits) reader.require(array.size() == count, wrong);
  };
  const auto all = members(traffic);
  std::apply([&](const auto&... each) { (require_count(archive::plain(each)), ...); }, all);
  reader.require((count == 0 || (traffic.table.lowest >= 1 && traffic.table.lowest <= traffic.table.highest)) &&
                     traffic.order.lanes.size() == lanes && traffic.order.has_straddlers.size() == lanes,
                 wrong);
  if (!reader.ok()) return;
  const auto is_lane = [&](int lane) { return lane >= 0 && lane < static_cast<int>(lanes); };
  const auto is_near = [&](double x_m) { return std::abs(x_m) <= traffic.corridor.length_m + 1e5; };
  for (std::size_t i = 0; i < count; ++i)
    reader.require(traffic.model[i] < vehicle_models().size() && is_lane(traffic.lane[i]) &&
                       is_lane(traffic.from_lane[i]) && is_near(traffic.x_m[i]) &&
                       std::isfinite(traffic.speed_mps[i]) && traffic.making_way[i] <= MakingWay::leave_lane,
                   wrong);
  for (const auto& lane : traffic.order.lanes)
    for (const LaneEntry& entry : lane)
      reader.require((entry.vehicle < 0 || static_cast<std::size_t>(entry.vehicle) < count) && is_near(entry.x_m),
                     wrong);
  for (const RampMouth& mouth : traffic.exits) reader.require(is_lane(mouth.lane), wrong);
}

void require_whole(const road::RoadNetwork& network, const TrafficParameters& parameters, const TrafficState& state,
                   StateReader& reader) {
  constexpr auto wrong = "traffic in it does not fit together";
  for (const VehicleClass& kind : parameters.classes) reader.require(kind.model < vehicle_models().size(), wrong);
  reader.require(state.corridors.empty() || (!parameters.classes.empty() && parameters.decision_interval_s > 0.0),
                 wrong);
  for (const Ramp& ramp : state.ramps) {
    if (!reader.require(ramp.main < state.corridors.size() && ramp.way < state.corridors.size(), wrong)) return;
    const auto has_lane = [](const CorridorTraffic& traffic, int lane) {
      return lane > 0 && lane < static_cast<int>(traffic.order.lanes.size());
    };
    const CorridorTraffic &main = state.corridors[ramp.main], &way = state.corridors[ramp.way];
    reader.require(has_lane(main, ramp.exit.lane) && has_lane(main, ramp.entry.lane) && has_lane(way, ramp.lane),
                   wrong);
  }
  for (const auto& place : state.foreign_places)
    if (place) road::require_on_roads(reader, network, *place);
}

}  // namespace

void hash_state(StateHash& hash, const TrafficState& state) {
  hash_members(hash, state);
  for (const CorridorTraffic& traffic : state.corridors) hash_members(hash, traffic);
}

void save_traffic(const TrafficParameters& parameters, const TrafficState& state, StateWriter& writer) {
  transfer(writer, parameters);
  transfer(writer, state);
  const std::uint64_t corridors = state.corridors.size();
  transfer(writer, corridors);
  for (const CorridorTraffic& traffic : state.corridors) {
    const RoadsOfCorridor roads = roads_of(traffic.corridor);
    transfer(writer, roads);
    transfer(writer, traffic);
  }
}

void restore_traffic(const road::RoadNetwork& network, StateReader& reader, TrafficParameters& parameters,
                     TrafficState& state) {
  transfer(reader, parameters);
  transfer(reader, state);
  const std::size_t corridors = transfer_count(reader);
  // Two directions of travel, and no more ramps than roads.
  reader.require(corridors <= network.roads.size() + 2, "traffic in it has other roads");
  state.corridors.clear();
  for (std::size_t i = 0; i < corridors && reader.ok(); ++i) {
    RoadsOfCorridor roads;
    transfer(reader, roads);
    const Corridor corridor = corridor_of(network, roads, reader);
    if (!reader.ok()) return;
    CorridorTraffic& traffic = state.corridors.emplace_back(empty_corridor(network, corridor));
    transfer(reader, traffic);
    require_whole(traffic, reader);
  }
  require_whole(network, parameters, state, reader);
}

}  // namespace septet::traffic
