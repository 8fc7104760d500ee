#include "engine/road/body_lanes.hpp"

#include <doctest/doctest.h>

#include "road_files.hpp"
#include "tests/shipped_files.hpp"

namespace septet::road {
namespace {

/// Two lanes of 3.5 m to drive on and a hard shoulder of 2.5 m, all on the right.
RoadNetwork road_with_shoulder() {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lane(-1, 3.5) + lane(-2, 3.5) +
                  lane(-3, 2.5, "", "shoulder") + "</right></laneSection>";
  return read_or_fail(road.xml());
}

LaneRange lanes_under_car(const RoadNetwork& network, double t_m, double heading_rad = 0.0) {
  return drivable_lanes_under(network, {0, 50.0, t_m}, {heading_rad, 1.0, 3.8, 1.8});
}

}  // namespace

TEST_CASE("who stands on the hard shoulder is in no lane until the body reaches over the edge line") {
  const RoadNetwork network = road_with_shoulder();
  CHECK(lanes_under_car(network, -8.25).empty());
  CHECK(lanes_under_car(network, -7.8).empty());  // 10 cm over the line.
  const LaneRange over_the_line = lanes_under_car(network, -7.5);
  CHECK(over_the_line.contains(-2));
  CHECK_FALSE(over_the_line.contains(-1));
}

TEST_CASE("a body lies over the lanes that its corners reach, turned or straight") {
  const RoadNetwork network = road_with_shoulder();
  const LaneRange in_the_middle = lanes_under_car(network, -1.75);
  CHECK(in_the_middle.contains(-1));
  CHECK_FALSE(in_the_middle.contains(-2));
  const LaneRange on_the_line = lanes_under_car(network, -3.5);
  CHECK(on_the_line.contains(-1));
  CHECK(on_the_line.contains(-2));
  CHECK(lanes_under_car(network, -1.75, -0.5).contains(-2));  // Its nose.
}

}  // namespace septet::road
