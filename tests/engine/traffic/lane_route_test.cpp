#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/network/lane_route.hpp"
#include "tests/engine/traffic/crossing_road.hpp"
#include "tests/engine/traffic/public_town.hpp"
#include "tests/engine/traffic/ten_routes.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::traffic {
namespace {

road::RoadNetwork own_town() {
  auto network = road::read_opendrive(shipped_text("scenarios/town/town.xodr"), "town.xodr");
  REQUIRE(network.has_value());
  return *network;
}

std::vector<PlaceOnLane> goal_of(const LaneGraph& graph, const road::RoadNetwork& network, const std::string& place) {
  auto goal = find_goal(graph, network, place);
  REQUIRE(goal.has_value());
  return *goal;
}

}  // namespace

TEST_CASE("a route over a crossing takes the connection to the arm of the goal") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  const PlaceOnLane from = lanes_at(graph, network, *road::find_road(network, "south"), 50.0).back();
  for (const std::string arm : {"east", "north", "west"}) {
    const auto route = plan_route(graph, from, goal_of(graph, network, arm + ":100"));
    REQUIRE(route.has_value());
    REQUIRE(route->steps.size() == 3);
    CHECK(faults(graph, *route) == 0);
    CHECK(network.roads[graph.ways[route->steps[1].enters].road].id == "south-" + arm);
    CHECK(route->length_m == doctest::Approx(150.0 + graph.ways[route->steps[1].enters].length_m + 100.0));
  }
}

TEST_CASE("a goal that no lanes lead to has no route") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  // Out of the network's end, on the lane that leads away.
  const PlaceOnLane leaving = lanes_at(graph, network, *road::find_road(network, "south"), 50.0).front();
  REQUIRE(graph.ways[leaving.way].next.count == 0);
  CHECK_FALSE(plan_route(graph, leaving, goal_of(graph, network, "north")).has_value());
  const std::vector<PlaceOnLane> passed{{leaving.way, leaving.at_m - 10.0}};
  CHECK_FALSE(plan_route(graph, leaving, passed).has_value());
  const std::vector<PlaceOnLane> ahead{{leaving.way, leaving.at_m + 10.0}};
  const auto route = plan_route(graph, leaving, ahead);
  REQUIRE(route.has_value());
  CHECK(route->length_m == doctest::Approx(10.0));
}

TEST_CASE("a goal is named by a road's name or id, a station on it, or a place of the world; others are told") {
  const road::RoadNetwork network = own_town();
  const LaneGraph graph = build_lane_graph(network);
  CHECK(goal_of(graph, network, "Bahnhofsplatz").size() >= 1);
  CHECK(goal_of(graph, network, "Südring").size() > 2);
  CHECK(goal_of(graph, network, "1").size() == 2);
  const auto at_station = goal_of(graph, network, "1:40");
  REQUIRE(at_station.size() == 2);
  const Vec3 there = place_on_way(graph, graph.ways[at_station[0].way], at_station[0].at_m).position_m;
  const auto at_place = goal_of(graph, network, std::to_string(there.x) + "," + std::to_string(there.y));
  REQUIRE(at_place.size() == 2);
  CHECK(at_place[0].way == at_station[0].way);
  CHECK(at_place[0].at_m == relative(at_station[0].at_m, 0.01));
  for (const char* wrong : {"", "Nowhere", "1:1e9", "1:-1", "1:", "90000,90000", "nan,1", "1:nan"}) {
    CAPTURE(wrong);
    CHECK_FALSE(find_goal(graph, network, wrong).has_value());
  }
}

TEST_CASE("a body stands in the lane that leads where it heads") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  for (WayIndex index = 0; index < graph.ways.size(); ++index) {
    const Way& way = graph.ways[index];
    const PlaceOnWay place = place_on_way(graph, way, 0.6 * way.length_m);
    const auto found =
        lanes_under(graph, network, Vec2(place.position_m), std::atan2(place.tangent.y, place.tangent.x));
    CHECK(std::ranges::find(found, index, &PlaceOnLane::way) != found.end());
    if (!way.in_junction()) CHECK(found.size() == 1);
    for (const PlaceOnLane& lane : found)
      CHECK(glm::distance(place_on_way(graph, graph.ways[lane.way], lane.at_m).position_m, place.position_m) < 2.5);
  }
}

TEST_CASE("ten routes of 5 km in the own town hold together") { drives_ten_routes(own_town()); }

TEST_CASE("ten routes of 5 km in each public town hold together") {
  drives_ten_routes(public_town("Town01"));
  drives_ten_routes(public_town("Town03"));
}

TEST_CASE("lanes are changed before a turn to those from which it begins") {
  const road::RoadNetwork network = public_town("Town03");
  const LaneGraph graph = build_lane_graph(network);
  int changes = 0, with_choice = 0;
  for (WayIndex from = 0; from < graph.ways.size(); from += 7) {
    if (graph.ways[from].in_junction()) continue;
    const std::vector<PlaceOnLane> to{{static_cast<WayIndex>((from * 31u + 11u) % graph.ways.size()), 1.0}};
    const auto route = plan_route(graph, {from, 0.0}, to);
    if (!route) continue;
    CHECK(faults(graph, *route) == 0);
    for (std::size_t i = 0; i + 1 < route->steps.size(); ++i) {
      const auto lanes = lanes_for_next(graph, *route, i);
      CHECK(std::ranges::binary_search(lanes, route->steps[i].leaves));
      if (route->steps[i].enters != route->steps[i].leaves) ++changes;
      if (lanes.size() > 1) ++with_choice;
    }
  }
  CHECK(changes > 10);
  CHECK(with_choice > 10);
}

}  // namespace septet::traffic
