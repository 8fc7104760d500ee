#include "engine/roadside/road_shape.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::roadside {
namespace {

/// A hundred metres uphill, with a tunnel from 40 m to 60 m and a bridge from 80 m to 90 m.
road::RoadNetwork climbing_road() {
  road::SmallRoad file;
  file.profiles =
      "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0.05\" c=\"0\" d=\"0\"/></elevationProfile>"
      "<objects><tunnel s=\"40\" length=\"20\" id=\"1\" type=\"standard\"/>"
      "<bridge s=\"80\" length=\"10\" id=\"2\" type=\"concrete\"/></objects>";
  return road::read_or_fail(file.xml());
}

}  // namespace

TEST_CASE("a road runs on straight beyond an end that is linked to nothing and its grade runs out") {
  const auto network = climbing_road();
  const RoadShape roads(network, 1500.0);
  CHECK(roads.begin_m(0) == -1500.0);
  CHECK(roads.end_m(0) == 1600.0);
  const auto beyond = [](double distance_m) { return 0.05 * 250.0 * std::tanh(distance_m / 250.0); };
  for (const double distance_m : {1.0, 100.0, 1500.0}) {
    const Vec3 after = roads.point(0, 100.0 + distance_m, 2.0), before = roads.point(0, -distance_m, 2.0);
    CHECK(after.x == relative(100.0 + distance_m, 1e-9));
    CHECK(after.y == relative(2.0, 1e-9));
    CHECK(after.z == relative(5.0 + beyond(distance_m), 1e-6));
    CHECK(before.x == relative(-distance_m, 1e-9));
    CHECK(before.z == relative(-beyond(distance_m), 1e-6));
  }
}

TEST_CASE("a road that is linked ends where its file says") {
  auto network = climbing_road();
  network.roads[0].successor.road = 0;
  network.roads[0].predecessor.junction = 0;
  const RoadShape roads(network, 1500.0);
  CHECK(roads.begin_m(0) == 0.0);
  CHECK(roads.end_m(0) == 100.0);
}

TEST_CASE("height over a road is along its surface's normal") {
  const auto network = climbing_road();
  const RoadShape roads(network, 0.0);
  const Vec3 foot = roads.point(0, 50.0, 0.0), up = roads.point(0, 50.0, 0.0, 2.0) - foot;
  const double slope = std::atan(0.05);
  CHECK(up.x == relative(-2.0 * std::sin(slope), 1e-9));
  CHECK(up.z == relative(2.0 * std::cos(slope), 1e-9));
}

TEST_CASE("tiles are cut where a road ends or a structure does and lie without gaps") {
  const auto network = climbing_road();
  const RoadShape roads(network, 70.0);
  const auto tiles = roads.tiles(30.0);
  std::vector<double> ends;
  for (const RoadTile& tile : tiles) ends.push_back(tile.s1_m);
  const std::vector<double> expected{-70.0 + 70.0 / 3.0, -70.0 + 140.0 / 3.0, 0.0,  20.0, 40.0, 60.0, 80.0, 90.0, 100.0,
                                     100.0 + 70.0 / 3.0, 100.0 + 140.0 / 3.0, 170.0};
  REQUIRE(ends.size() == expected.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    CAPTURE(i);
    CHECK(ends[i] == doctest::Approx(expected[i]).epsilon(1e-9).scale(1.0));
    CHECK(tiles[i].s0_m == (i == 0 ? -70.0 : tiles[i - 1].s1_m));
    CHECK(tiles[i].in_tunnel == (expected[i] == 60.0));
    CHECK(tiles[i].on_bridge == (expected[i] == 90.0));
    const glm::vec3 middle = roads.local(tiles[i], tiles[i].middle_m(), 0.0);
    CHECK(glm::length(middle) < 1e-4f);
    CHECK(roads.local(tiles[i], tiles[i].middle_m(), 1.0).y == relative(1.0, 1e-4));
  }
}

TEST_CASE("stations of a tile are even and hold both ends") {
  RoadTile tile;
  tile.s0_m = 10.0;
  tile.s1_m = 110.0;
  CHECK(stations(tile, 30.0) == std::vector<double>{10.0, 35.0, 60.0, 85.0, 110.0});
  CHECK(stations(tile, 50.0) == std::vector<double>{10.0, 60.0, 110.0});
  CHECK(stations(tile, 1000.0) == std::vector<double>{10.0, 110.0});
}

}  // namespace septet::roadside
