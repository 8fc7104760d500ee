#include "engine/road/lane_links.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "road_files.hpp"
#include "tests/relative.hpp"

namespace septet::road {
namespace {

/// Distance of the world's jump from one lane position to the next.
double gap_m(const RoadNetwork& network, const LanePosition& a, const LanePosition& b) {
  return glm::distance(evaluate_lane(network, a).road.position_m, evaluate_lane(network, b).road.position_m);
}

}  // namespace

TEST_CASE("a lane of the motorway is driven from end to end both ways without a jump") {
  const RoadNetwork& network = motorway();
  for (const LanePosition start : {LanePosition{*find_road(network, "1"), -4, 0.0, 0.2},
                                   LanePosition{*find_road(network, "3"), 6, 2908.0, -0.2}}) {
    LanePosition at = start;
    double driven = 0.0;
    for (Advanced next; driven < 9'990.0; at = next.position, driven += 10.0) {
      next = advance(network, at, 10.0);
      REQUIRE(next.remaining_m == 0.0);
      REQUIRE(gap_m(network, at, next.position) == relative(10.0, 0.03));
      REQUIRE(next.position.lane == start.lane);
    }
    const Advanced end = advance(network, at, 1000.0);
    CHECK(end.remaining_m == doctest::Approx(990.0));
    const Advanced back = advance(network, at, -driven);
    CHECK(back.position.road == start.road);
    CHECK(back.position.s_m == doctest::Approx(start.s_m));
  }
}

TEST_CASE("the exit leads through the rest area back to the motorway") {
  const RoadNetwork& network = motorway();
  LanePosition at{*find_road(network, "1"), -8, 6200.0, 0.0};
  CHECK(lane_type(network, at.road, at.lane, at.s_m) == LaneType::exit);
  std::string roads;
  for (int i = 0; i < 105; ++i) {
    const Advanced next = advance(network, at, 10.0);
    CAPTURE(roads);
    REQUIRE(next.remaining_m == 0.0);
    REQUIRE(gap_m(network, at, next.position) < 10.5);
    if (next.position.road != at.road) roads += network.roads[next.position.road].id + " ";
    at = next.position;
  }
  CHECK(roads == "11 12 13 3 ");
  CHECK(lane_type(network, at.road, at.lane, at.s_m) == LaneType::entry);
}

TEST_CASE("a driver who has the choice takes the way that is chosen") {
  // A road that forks into two at a direct junction.
  const auto road = [](const char* id, double y_m, const std::string& link) {
    return SmallRoad{.length_m = 50.0, .sections = lane_section("", lane(-1, 3.5)), .id = id, .link = link, .y_m = y_m}
        .text();
  };
  const std::string from_junction = link_to_junction("predecessor", "j");
  const std::string xml = roads_text(road("in", 0.0, link_to_junction("successor", "j")) +
                                     road("left", 10.0, from_junction) + road("right", -10.0, from_junction) +
                                     "<junction id=\"j\" type=\"direct\">"
                                     "<connection id=\"0\" incomingRoad=\"in\" linkedRoad=\"left\" "
                                     "contactPoint=\"start\"><laneLink from=\"-1\" to=\"-1\"/></connection>"
                                     "<connection id=\"1\" incomingRoad=\"in\" linkedRoad=\"right\" "
                                     "contactPoint=\"start\"><laneLink from=\"-1\" to=\"-1\"/></connection>"
                                     "</junction>");
  const RoadNetwork network = read_or_fail(xml);
  const LanePosition start{0, -1, 45.0, 0.0};
  CHECK(advance(network, start, 10.0).position.road == 1);
  const auto second = [](std::span<const LaneContinuation> ways) { return ways.size() - 1; };
  CHECK(advance(network, start, 10.0, second).position.road == 2);
  CHECK(advance(network, {2, -1, 5.0, 0.0}, -10.0).position.road == 0);
}

TEST_CASE("the limit of a lane is its own or that of the road") {
  CHECK(speed_limit_mps(motorway(), {0, -4, 100.0, 0.0}) == doctest::Approx(120.0 / 3.6));
}

}  // namespace septet::road
