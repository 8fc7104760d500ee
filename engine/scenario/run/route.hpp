#pragma once
/// Routes over a road network: the roads from waypoint to waypoint, and the choice between several continuations.

#include <span>
#include <vector>

#include "engine/road/lane_links.hpp"
#include "engine/road/road_network.hpp"

namespace septet::scenario {

/// A place on the route and its direction of travel.
struct Waypoint {
  road::LanePosition lane;
  bool along_s = true;
};

/// Waypoints with their places on the roads, and the roads that lead over them.
struct PlannedRoute {
  std::vector<Waypoint> waypoints;
  std::vector<road::RoadIndex> roads;
};

/// Roads in driving order, from the first waypoint's to the last's: the shortest path, on lanes that lead into each
/// other. Where a waypoint cannot be reached, or `lanes_left` lanes have been examined, it ends earlier.
std::vector<road::RoadIndex> plan_route(const road::RoadNetwork& network, std::span<const Waypoint> waypoints,
                                        std::size_t& lanes_left);
/// Limits of the lanes examined for one route, and for all routes of a scenario.
inline constexpr std::size_t most_lanes_of_route = 200'000, most_lanes_of_scenario = 1'000'000;

/// Chooses the continuation on the next road of `roads`, else the straightest. Must not outlive its arguments.
road::ChooseContinuation choose_way(const road::RoadNetwork& network, std::span<const road::RoadIndex> roads);

}  // namespace septet::scenario
