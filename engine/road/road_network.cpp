#include "engine/road/road_network.hpp"

namespace septet::road {

std::optional<RoadIndex> find_road(const RoadNetwork& network, std::string_view id) {
  for (RoadIndex i = 0; i < network.roads.size(); ++i) {
    if (network.roads[i].id == id) return i;
  }
  return std::nullopt;
}

}  // namespace septet::road
