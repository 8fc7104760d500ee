#include "engine/road/lane_links.hpp"

#include <algorithm>
#include <cmath>

#include "engine/road/lane_geometry.hpp"

namespace septet::road {
namespace {

std::uint32_t section_at_contact(const Road& road, ContactPoint contact) {
  return contact == ContactPoint::start ? 0 : static_cast<std::uint32_t>(road.sections.size() - 1);
}

void enter_road(const RoadNetwork& network, RoadIndex index, ContactPoint contact, int lane,
                std::vector<LaneContinuation>& found) {
  const Road& road = network.roads[index];
  const std::uint32_t section = section_at_contact(road, contact);
  if (lane == 0 || !road.sections[section].has_lane(lane)) return;
  found.push_back({index, section, lane, contact == ContactPoint::start});
}

/// The end of `road` at the junction; its end where both touch it.
ContactPoint end_at_junction(const Road& road, JunctionIndex junction) {
  return road.successor.junction == junction ? ContactPoint::end : ContactPoint::start;
}

void enter_junction(const RoadNetwork& network, JunctionIndex index, RoadIndex from, int lane,
                    std::vector<LaneContinuation>& found) {
  const Junction& junction = network.junctions[index];
  for (const JunctionConnection& connection : junction.connections) {
    for (const LaneLink& link : connection.lane_links) {
      if (connection.incoming == from && link.from == lane) {
        enter_road(network, connection.connecting, connection.contact, link.to, found);
      }
      // A direct junction is passed both ways: there is no connecting road with own links back.
      if (junction.kind == Junction::Kind::direct && connection.connecting == from && link.to == lane) {
        const ContactPoint contact = end_at_junction(network.roads[connection.incoming], index);
        enter_road(network, connection.incoming, contact, link.from, found);
      }
    }
  }
}

}  // namespace

bool runs_along_s(const Road& road, const LaneSection& section, int lane) {
  const bool right_side = lane < 0;
  const bool along = right_side == (road.rule == TrafficRule::right_hand);
  const bool reversed = section.has_lane(lane) && section.lane(lane).direction == LaneDirection::reversed;
  return along != reversed;
}

bool runs_along_s(const RoadNetwork& network, const LanePosition& position) {
  const Road& road = network.roads[position.road];
  return runs_along_s(road, section_at(road, position.s_m), position.lane);
}

std::vector<LaneContinuation> continuations(const RoadNetwork& network, RoadIndex road_index,
                                            std::uint32_t section_index, int lane, bool towards_increasing_s) {
  const Road& road = network.roads[road_index];
  const LaneSection& section = road.sections[section_index];
  std::vector<LaneContinuation> found;
  if (lane == 0 || !section.has_lane(lane)) return found;
  const std::vector<int>& linked =
      towards_increasing_s ? section.lane(lane).successors : section.lane(lane).predecessors;

  const bool last = towards_increasing_s ? section_index + 1 == road.sections.size() : section_index == 0;
  if (!last) {
    const std::uint32_t next = towards_increasing_s ? section_index + 1 : section_index - 1;
    for (const int to : linked) {
      if (to != 0 && road.sections[next].has_lane(to)) found.push_back({road_index, next, to, towards_increasing_s});
    }
    return found;
  }
  const RoadLink& link = towards_increasing_s ? road.successor : road.predecessor;
  if (link.road != no_index) {
    for (const int to : linked) enter_road(network, link.road, link.contact, to, found);
  } else if (link.junction != no_index) {
    enter_junction(network, link.junction, road_index, lane, found);
  }
  return found;
}

Advanced advance(const RoadNetwork& network, const LanePosition& from, double distance_m,
                 const ChooseContinuation& choose) {
  Advanced at{from, runs_along_s(network, from) == (distance_m >= 0.0), std::abs(distance_m)};
  auto section = static_cast<std::uint32_t>(section_index_at(network.roads[from.road], from.s_m));
  int crossings_without_way = 0;
  for (;;) {
    const Road& road = network.roads[at.position.road];
    const double end = at.towards_increasing_s ? road.sections[section].s_end_m : road.sections[section].s_m;
    const double room = std::max(0.0, at.towards_increasing_s ? end - at.position.s_m : at.position.s_m - end);
    if (at.remaining_m <= room) {
      at.position.s_m += at.towards_increasing_s ? at.remaining_m : -at.remaining_m;
      at.remaining_m = 0.0;
      return at;
    }
    at.position.s_m = end;
    at.remaining_m -= room;
    // A ring of roads without length would never use the distance up.
    crossings_without_way = room > 0.0 ? 0 : crossings_without_way + 1;
    const auto next = continuations(network, at.position.road, section, at.position.lane, at.towards_increasing_s);
    if (next.empty() || crossings_without_way > 1000) return at;
    const std::size_t chosen = next.size() > 1 && choose ? std::min(choose(next), next.size() - 1) : 0;
    const LaneContinuation& to = next[chosen];
    const Road& to_road = network.roads[to.road];
    const double s = to.towards_increasing_s ? to_road.sections[to.section].s_m : to_road.sections[to.section].s_end_m;
    const double offset =
        to.towards_increasing_s == at.towards_increasing_s ? at.position.offset_m : -at.position.offset_m;
    at.position = {to.road, to.lane, s, offset};
    at.towards_increasing_s = to.towards_increasing_s;
    section = to.section;
  }
}

}  // namespace septet::road
