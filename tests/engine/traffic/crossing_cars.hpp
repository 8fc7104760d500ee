#pragma once
/// Cars on the crossing of crossing_road.hpp, each with a route of its own.

#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "engine/road/road_network.hpp"
#include "engine/traffic/network/town.hpp"
#include "engine/traffic/traffic.hpp"

namespace septet::traffic {

inline constexpr ParticipantId first_car_id = 1000;

inline WayIndex way_of_road(const road::RoadNetwork& network, const LaneGraph& graph, const std::string& id,
                            bool along_s) {
  const auto road = road::find_road(network, id);
  REQUIRE(road.has_value());
  for (WayIndex index = 0; index < graph.ways.size(); ++index)
    if (graph.ways[index].road == *road && graph.ways[index].along_s == along_s) return index;
  FAIL("no way of road " << id);
  return no_way;
}

/// A car on an arm, `before_m` from its end, that will drive this connection.
inline void add_car(const road::RoadNetwork& network, const LaneGraph& graph, const std::string& from,
                    const std::string& to, double before_m, TownState& town) {
  const TrafficParameters parameters = motorway_traffic(1, 1000.0);
  TownVehicle car;
  car.id = first_car_id + static_cast<ParticipantId>(town.vehicles.size());
  car.model = parameters.classes.front().model;
  car.driver = parameters.classes.front().middle;
  car.law = FollowingLaw(car.driver.following);
  car.outside = false;
  car.route = {way_of_road(network, graph, from, true), way_of_road(network, graph, from + "-" + to, true),
               way_of_road(network, graph, to, false)};
  car.front_m = graph.ways[car.route.front()].length_m - before_m;
  car.speed_mps = 10.0;
  town.vehicles.push_back(std::move(car));
}

}  // namespace septet::traffic
