#include "engine/road/lane_geometry.hpp"

#include <doctest/doctest.h>

#include "road_files.hpp"

namespace septet::road {

TEST_CASE("a lane outside one that widens turns with it") {
  const std::string xml =
      replaced(SmallRoad{.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lane(-1, 3.5) +
                                     lane(-2, 3.0) + "</right></laneSection>"}
                   .xml(),
               "a=\"3.5\" b=\"0\" c=\"0\"", "a=\"1\" b=\"0.02\" c=\"0.001\"");
  const RoadNetwork network = read_or_fail(xml);
  for (const double s : {0.5, 30.0, 99.0}) {
    const double h = 1e-4;
    const Vec3 before = evaluate_lane(network, {0, -2, s - h, 0.0}).road.position_m,
               after = evaluate_lane(network, {0, -2, s + h, 0.0}).road.position_m;
    const LanePoint point = evaluate_lane(network, {0, -2, s, 0.0});
    CHECK(point.lane_slope == doctest::Approx(-(0.02 + 0.002 * s)));
    CHECK(point.driving_heading_rad == doctest::Approx(std::atan2(after.y - before.y, after.x - before.x)));
  }
}

TEST_CASE("a border that lies inside its inner neighbour's leaves the lane without width") {
  SmallRoad road;
  const auto border = [](int id, const char* a, const char* b) {
    return "<lane id=\"" + std::to_string(id) + "\" type=\"driving\"><border sOffset=\"0\" a=\"" + a + "\" b=\"" + b +
           "\" c=\"0\" d=\"0\"/></lane>";
  };
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + border(-1, "-3", "0") +
                  border(-2, "-6", "0.06") + border(-3, "-9", "0") + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  // The border of lane -2 crosses that of lane -1 at s = 50.
  CHECK(lane_width_m(network, 0, -2, 25.0) == doctest::Approx(1.5));
  CHECK(lane_width_m(network, 0, -2, 75.0) == 0.0);
  CHECK(lane_width_m(network, 0, -3, 75.0) == doctest::Approx(6.0));
  const LanesAt beside = lanes_at(network.roads[0], 75.0, -4.0);
  CHECK(beside.lane == -3);
}

TEST_CASE("a lateral shape is found among two hundred thousand a million times") {
  RoadNetwork network = read_or_fail(SmallRoad{}.xml());
  Road& road = network.roads[0];
  road.flat = false;
  for (int s = 0; s < 2; ++s)
    for (int t = 0; t < 100'000; ++t)
      road.shapes.push_back({10.0 + 80.0 * s, -50.0 + 0.001 * t, 0.001 * t, 0.0, 0.0, 0.0});
  for (LateralShape& shape : road.shapes)
    if (shape.s_m > 50.0) shape.a += 1.0;
  CHECK(surface_offset_m(road, 0.0, -60.0) == doctest::Approx(0.0));
  CHECK(surface_offset_m(road, 10.0, -49.9985) == doctest::Approx(0.001));
  CHECK(surface_offset_m(road, 50.0, -50.0) == doctest::Approx(0.5));
  CHECK(surface_offset_m(road, 90.0, 0.0) == doctest::Approx(51.0));
  CHECK(surface_offset_m(road, 200.0, 100.0) == doctest::Approx(100.999));
  double sum = 0.0;
  for (int i = 0; i < 1'000'000; ++i) sum += surface_offset_m(road, 30.0, 49.9995);
  CHECK(sum == doctest::Approx(1e6 * (99.999 + 0.25)));
}

}  // namespace septet::road
