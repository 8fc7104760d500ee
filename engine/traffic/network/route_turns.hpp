#pragma once
/// The turns of a route that its driver has to be told, in their order. Pure functions.

#include <cstddef>
#include <vector>

#include "engine/traffic/network/lane_route.hpp"
#include "engine/world/guidance.hpp"

namespace septet::traffic {

struct RouteTurn {
  GuidanceWord word;  ///< Without its time.
  double at_m = 0.0;  ///< Where it begins, from the route's begin.
  double ends_m = 0.0;
  bool is_told = true;  ///< False: the road goes on, and nobody who is told nothing turns off it.
};

/// At each junction where the road forks; the last one is the arrival. A roundabout is one turn, whose exits are counted
/// from where it is entered. Straight on is told where another way leads as nearly straight on.
std::vector<RouteTurn> route_turns(const LaneGraph& graph, const road::RoadNetwork& network, const LaneRoute& route);

/// The lanes of a step's section from which the next turn is reached without another change; where there is no such one,
/// those of the route. Ascending.
std::vector<WayIndex> lanes_towards_turn(const LaneGraph& graph, const LaneRoute& route, std::size_t step);

}  // namespace septet::traffic
