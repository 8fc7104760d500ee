#include <algorithm>
#include <string>
#include <utility>

#include <doctest/doctest.h>

#include "tests/engine/traffic/crossing_road.hpp"

namespace septet::traffic {
namespace {

/// The connection from one arm to another.
const Way& connection(const road::RoadNetwork& network, const LaneGraph& graph, const std::string& id) {
  const auto road = road::find_road(network, id);
  REQUIRE(road.has_value());
  const auto found = std::ranges::find(graph.ways, *road, &Way::road);
  REQUIRE(found != graph.ways.end());
  return *found;
}

bool meets(const LaneGraph& graph, const Way& a, const Way& b, WayConflict::Kind kind) {
  return std::ranges::any_of(graph.conflicts_of(a), [&](const WayConflict& conflict) {
    return &graph.ways[conflict.with] == &b && conflict.kind == kind;
  });
}

}  // namespace

TEST_CASE("ways of a crossing that cross, run together or part meet as what they are, and others do not") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  using Kind = WayConflict::Kind;
  const auto way = [&](const char* id) -> const Way& { return connection(network, graph, id); };
  CHECK(has_crossings(graph));
  CHECK(meets(graph, way("south-north"), way("east-west"), Kind::crossing));
  CHECK(meets(graph, way("east-west"), way("south-north"), Kind::crossing));
  CHECK(meets(graph, way("south-north"), way("west-north"), Kind::merging));
  CHECK(meets(graph, way("south-north"), way("south-west"), Kind::diverging));
  CHECK(meets(graph, way("south-west"), way("north-south"), Kind::crossing));
  const auto apart = [&](const char* a, const char* b) {
    return std::ranges::none_of(graph.conflicts_of(way(a)),
                                [&](const WayConflict& c) { return &graph.ways[c.with] == &way(b); });
  };
  CHECK(apart("south-north", "north-south"));
  CHECK(apart("south-east", "north-west"));
}

TEST_CASE("a conflict's two stretches are the same two pieces of road, from either side") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  for (std::size_t i = 0; i < graph.ways.size(); ++i)
    for (const WayConflict& conflict : graph.conflicts_of(graph.ways[i])) {
      CHECK(conflict.from_m < conflict.to_m);
      const auto back = graph.conflicts_of(graph.ways[conflict.with]);
      CHECK(std::ranges::any_of(back, [&](const WayConflict& other) {
        return other.with == i && other.from_m == conflict.with_from_m && other.with_to_m == conflict.to_m;
      }));
    }
}

TEST_CASE("who comes from the right goes first, from the left where traffic keeps left, and who turns across waits") {
  for (const bool left_hand : {false, true}) {
    CAPTURE(left_hand);
    const road::RoadNetwork network = crossing(left_hand);
    const LaneGraph graph = build_lane_graph(network);
    const auto way = [&](const char* id) -> const Way& { return connection(network, graph, id); };
    // Seen from the south, the right is the east.
    CHECK(yields_to(way("south-north"), way("east-west")) == !left_hand);
    CHECK(yields_to(way("east-west"), way("south-north")) == left_hand);
    const char* across = left_hand ? "south-east" : "south-west";
    CHECK(yields_to(way(across), way("north-south")));
    CHECK_FALSE(yields_to(way("north-south"), way(across)));
    CHECK_FALSE(yields_to(way("south-north"), way("north-south")));
  }
}

TEST_CASE("a give-way sign ranks below a priority sign, whoever comes from the right") {
  const road::RoadNetwork network = crossing(false, Posted::signs);
  const LaneGraph graph = build_lane_graph(network);
  const auto way = [&](const char* id) -> const Way& { return connection(network, graph, id); };
  CHECK(yields_to(way("west-east"), way("south-north")));
  CHECK(yields_to(way("east-west"), way("south-north")));
  CHECK_FALSE(yields_to(way("south-north"), way("east-west")));
}

TEST_CASE("a junction's own order of roads goes before who comes from the right, and signs before that") {
  const auto ordered = [](const char* high, const char* low, Posted posted) {
    road::RoadNetwork network = crossing(false, posted);
    network.junctions.front().priorities = {
        {road::find_road(network, high).value(), road::find_road(network, low).value()}};
    return network;
  };
  // From the south the one from the east is on the right. Newer files name the roads that lead in, older ones those across.
  for (const auto& roads : {std::pair("south", "east"), std::pair("south-north", "east-west")}) {
    CAPTURE(roads.first);
    const road::RoadNetwork network = ordered(roads.first, roads.second, Posted::nothing);
    const LaneGraph graph = build_lane_graph(network);
    CHECK_FALSE(yields_to(connection(network, graph, "south-north"), connection(network, graph, "east-west")));
    CHECK(yields_to(connection(network, graph, "east-west"), connection(network, graph, "south-north")));
  }
  const road::RoadNetwork posted = ordered("west", "south", Posted::signs);
  const LaneGraph graph = build_lane_graph(posted);
  CHECK(yields_to(connection(posted, graph, "west-east"), connection(posted, graph, "south-north")));
}

TEST_CASE("a way's points are as long as its lane and its bends as slow as comfort asks") {
  const road::RoadNetwork network = crossing();
  const LaneGraph graph = build_lane_graph(network);
  const Way& right = connection(network, graph, "south-east");
  // A quarter of a circle of 8.25 m.
  CHECK(std::abs(right.length_m - 0.5 * 3.14159265 * right_turn_m) < 0.05);
  CHECK(std::abs(right.tightest_per_m * right_turn_m - 1.0) < 0.02);
  const AllowedSquare square = bend_square_at(graph, right, 0.5 * right.length_m);
  CHECK(square.m2ps2 * right.tightest_per_m < most_bend_mps2);
  CHECK(right.turns_rad < -1.5);
}

}  // namespace septet::traffic
