#pragma once
/// A road network in SUMO's words: the plain XML from which SUMO's `netconvert` builds its network.
///
/// Generated from Septet's own road network and not by netconvert's OpenDRIVE import: SUMO 1.15 knows no direct
/// junctions, and the import needs a type map that Debian does not ship. One edge per lane section and direction of
/// travel, with the centre line of every drivable lane as its shape in world x and y, so that a place is the same place
/// in both. Pure.

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/traffic/corridor.hpp"

namespace septet::server {

struct SumoEdge {
  std::string id;
  road::RoadIndex road = 0;
  std::uint32_t section = 0;
  bool along_s = true;
  double begin_s_m = 0.0, end_s_m = 0.0;  ///< Range of the section, ascending.
  std::vector<int> lanes;                 ///< OpenDRIVE ids by SUMO's lane index: the right-most first.
};

struct SumoNetwork {
  std::vector<SumoEdge> edges;
  /// Edges with a lane that continues into another one; ascending.
  std::vector<std::pair<std::size_t, std::size_t>> followers;
  std::string nodes_xml, edges_xml, connections_xml;
};

SumoNetwork make_sumo_network(const road::RoadNetwork& roads);

/// A place in SUMO's network, and the edges that follow it along the corridor as far as lanes lead into them.
struct SumoPlace {
  std::vector<std::string> route;  ///< The first is the place's own.
  int lane_index = 0;
  double along_m = 0.0;  ///< From the beginning of that edge.
};
/// Place of lane number `lane` of a corridor at x; an empty route if that lane cannot be driven on.
SumoPlace place_in_sumo(const SumoNetwork& network, const road::RoadNetwork& roads, const traffic::Corridor& corridor,
                        int lane, double x_m);

}  // namespace septet::server
