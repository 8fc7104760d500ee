#include "engine/roadside/town.hpp"

#include <algorithm>
#include <string_view>

#include "engine/road/cubic_record.hpp"

namespace septet::roadside {
namespace {

bool is_town_type(std::string_view type) {
  return type.starts_with("town") || type == "lowSpeed" || type == "pedestrian" || type == "bicycle";
}

bool has_pavement(const road::Road& road) {
  return std::ranges::any_of(road.sections, [](const road::LaneSection& section) {
    return std::ranges::any_of(section.lanes,
                               [](const road::Lane& lane) { return lane.type == road::LaneType::sidewalk; });
  });
}

bool says_so(const road::Road& road, double s_m) {
  if (road.types.empty()) return has_pavement(road);
  const std::string_view type = road.types[road::record_at(road.types, s_m)].type;
  return is_town_type(type) || ((type.empty() || type == "unknown") && has_pavement(road));
}

}  // namespace

bool is_in_town(const road::RoadNetwork& network, road::RoadIndex index, double s_m) {
  const road::Road& road = network.roads[index];
  if (says_so(road, s_m)) return true;
  if (road.junction == road::no_index || !road.types.empty()) return false;
  for (const road::RoadLink& link : {road.predecessor, road.successor}) {
    if (link.road == road::no_index) continue;
    const road::Road& next = network.roads[link.road];
    if (says_so(next, link.contact == road::ContactPoint::start ? 0.0 : next.length_m)) return true;
  }
  return false;
}

}  // namespace septet::roadside
