#pragma once
/// Routes over a road network: which roads lead from waypoint to waypoint, and which way to take where several go on.

#include <span>
#include <vector>

#include "engine/road/lane_links.hpp"
#include "engine/road/road_network.hpp"

namespace septet::scenario {

/// A place on the way and which way one drives there.
struct Waypoint {
  road::LanePosition lane;
  bool along_s = true;
};

/// Waypoints where they are on the roads, and the roads that lead over them.
struct PlannedRoute {
  std::vector<Waypoint> waypoints;
  std::vector<road::RoadIndex> roads;
};

/// Roads in the order in which one drives on them, from the first waypoint's to the last's: the shortest way, on lanes that lead
/// into each other. Where a waypoint cannot be reached, or `lanes_left` lanes have been looked at, it ends before.
std::vector<road::RoadIndex> plan_route(const road::RoadNetwork& network, std::span<const Waypoint> waypoints,
                                        std::size_t& lanes_left);
/// So many lanes are looked at for one route, and for all routes of a scenario, at most.
inline constexpr std::size_t most_lanes_of_route = 200'000, most_lanes_of_scenario = 1'000'000;

/// Takes the way whose road comes next in `roads`, else the straightest. Must not outlive its arguments.
road::ChooseContinuation choose_way(const road::RoadNetwork& network, std::span<const road::RoadIndex> roads);

}  // namespace septet::scenario
