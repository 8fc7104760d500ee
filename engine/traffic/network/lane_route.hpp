#pragma once
/// A route from one place of a road network to another, over lanes and connections: the quickest by limits and bends.
///
/// A step is one lane section that the route passes: the way by which it is entered and the one by which it is left,
/// beside each other where lanes are changed on it. Junctions are passed in one lane. Dijkstra's search (E. W. Dijkstra,
/// "A note on two problems in connexion with graphs", 1959) over the ways; a change of lanes costs `lane_change_s`, and
/// more where the section is short, so that lanes are chosen early. Time grows as the ways with their logarithm: the
/// 20 km of scenarios/town in about a millisecond. Pure functions; safe from many threads. Metres along lanes, seconds.

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/traffic/network/lane_graph.hpp"

namespace septet::traffic {

struct PlaceOnLane {
  WayIndex way = no_way;
  double at_m = 0.0;  ///< From where the way is entered.
  bool operator==(const PlaceOnLane&) const = default;
};

struct RouteStep {
  WayIndex enters = no_way, leaves = no_way;  ///< Of one section and direction.
  double begins_m = 0.0;                      ///< From the route's begin; before it for the first step.
  bool operator==(const RouteStep&) const = default;
};

struct LaneRoute {
  std::vector<RouteStep> steps;  ///< At least one.
  double length_m = 0.0, time_s = 0.0;
  PlaceOnLane from, to;
  std::vector<double> reached_m;  ///< Where each of its goals is reached, from its begin; the last is its length.
};

/// What a change of lanes costs, and the length of a section that leaves room for one.
inline constexpr double lane_change_s = 4.0, room_for_change_m = 60.0;

/// The quickest route to any of the places; empty: no lanes lead there.
std::optional<LaneRoute> plan_route(const LaneGraph& graph, const PlaceOnLane& from, std::span<const PlaceOnLane> to);

/// The same over several places, in their order: from each by way of the lane in which it was reached.
std::optional<LaneRoute> plan_route_over(const LaneGraph& graph, const PlaceOnLane& from,
                                         std::span<const std::vector<PlaceOnLane>> places);

/// The lanes that hold a point and lead about where a body heads, the one that does so best first: in a junction there
/// are several. Empty: off all lanes, or against their traffic.
std::vector<PlaceOnLane> lanes_under(const LaneGraph& graph, const road::RoadNetwork& network, const Vec2& world_m,
                                     double heading_rad);

/// All driving lanes of a road at a station.
std::vector<PlaceOnLane> lanes_at(const LaneGraph& graph, const road::RoadNetwork& network, road::RoadIndex road,
                                  double s_m);

/// The lanes at a place that a person names: "x,y" (world, metres; the nearest road within 200 m), a road's name or id,
/// its middle, or "id:s". A name may be that of several roads: all of them count. Error: no such place.
Expected<std::vector<PlaceOnLane>> find_goal(const LaneGraph& graph, const road::RoadNetwork& network,
                                             std::string_view place);

/// Ways of a step's section from which the next step's section is entered by a connection: the lanes for it. The last
/// step's: those with the goal. Ascending.
std::vector<WayIndex> lanes_for_next(const LaneGraph& graph, const LaneRoute& route, std::size_t step);

/// True for two ways of one lane section in one direction.
bool is_beside(const Way& a, const Way& b);

}  // namespace septet::traffic
