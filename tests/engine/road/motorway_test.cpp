#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "road_files.hpp"
#include "tests/relative.hpp"

namespace septet::road {

TEST_CASE("the motorway has no findings") {
  for (const Finding& finding : check_opendrive(motorway_text(), "motorway.xodr")) FAIL(describe(finding.error));
}

TEST_CASE("the motorway has ten kilometres with five driving lanes each way") {
  const RoadNetwork& network = motorway();
  double length = 0.0;
  for (const char* id : {"1", "2", "3"}) {
    const RoadIndex index = *find_road(network, id);
    length += network.roads[index].length_m;
    for (double s = 0.0; s < network.roads[index].length_m; s += 50.0) {
      for (const int lane : {-7, -6, -5, -4, -3, 3, 4, 5, 6, 7}) {
        REQUIRE(lane_type(network, index, lane, s) == LaneType::driving);
        REQUIRE(lane_width_m(network, index, lane, s) == doctest::Approx(3.75));
      }
    }
  }
  CHECK(length == doctest::Approx(10'000.0));
}

TEST_CASE("position and heading and height of the motorway run on smoothly across its records") {
  const RoadNetwork& network = motorway();
  for (RoadIndex index = 0; index < network.roads.size(); ++index) {
    RoadPoint before = evaluate(network, {index, 0.0, 0.0});
    for (double s = 1.0; s <= network.roads[index].length_m; s += 1.0) {
      const RoadPoint point = evaluate(network, {index, s, 0.0});
      REQUIRE(glm::distance(Vec2(point.position_m), Vec2(before.position_m)) == relative(1.0, 1e-3));
      REQUIRE(std::abs(wrap_angle(point.heading_rad - before.heading_rad)) < 1.0 / 240.0);
      REQUIRE(std::abs(point.pitch_rad - before.pitch_rad) < 1e-4);
      REQUIRE(std::abs(point.roll_rad - before.roll_rad) < 3e-4);
      before = point;
    }
  }
}

TEST_CASE("the motorway has a bridge and an 800 m tunnel and gantries and barriers") {
  const Road& road = motorway().roads[0];
  REQUIRE(road.structures.size() == 2);
  for (const RoadStructure& structure : road.structures) {
    if (structure.kind == RoadStructure::Kind::tunnel) CHECK(structure.length_m == 800.0);
  }
  int gantries = 0, rails = 0;
  for (const RoadObject& object : road.objects) {
    gantries += object.type == "gantry";
    rails += object.type == "barrier";
  }
  CHECK(gantries == 6);
  CHECK(rails == 5);
  CHECK(road.signals.size() == 60);
}

}  // namespace septet::road
