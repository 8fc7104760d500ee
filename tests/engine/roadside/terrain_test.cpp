#include "engine/roadside/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/lane_geometry.hpp"
#include "engine/roadside/buildings.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::roadside {
namespace {

/// A kilometre along x, rising from the right to the left: lanes 3 m to the left of the axis and 3.5 m to its right.
const RoadShape& tilted() {
  static const road::RoadNetwork network = [] {
    road::SmallRoad file;
    file.length_m = 1000.0;
    file.profiles =
        "<elevationProfile><elevation s=\"0\" a=\"7\" b=\"0\" c=\"0\" d=\"0\"/></elevationProfile>"
        "<lateralProfile><superelevation s=\"0\" a=\"0.05\" b=\"0\" c=\"0\" d=\"0\"/></lateralProfile>";
    return road::read_or_fail(file.xml());
  }();
  static const RoadShape roads(network, 0.0);
  return roads;
}

const RoadShape& motorway_shape() {
  static const RoadShape roads(road::motorway(), usual_overrun_m);
  return roads;
}
const Terrain& motorway_land() {
  static const Terrain terrain(motorway_shape(), 1);
  return terrain;
}

const road::RoadStructure& structure(road::RoadStructure::Kind kind) {
  for (const auto& structure : road::motorway().roads[0].structures)
    if (structure.kind == kind) return structure;
  FAIL("the motorway has no such structure");
  std::abort();
}

}  // namespace

TEST_CASE("a place beside a road knows where along and how far outside of its lanes it lies") {
  const Terrain terrain(tilted(), 1);
  for (const double x : {301.0, 310.0, 555.5}) {
    CAPTURE(x);
    const Nearest left = terrain.nearest({x, 23.0}), right = terrain.nearest({x, -23.5}),
                  on = terrain.nearest({x, 1.0});
    REQUIRE((left.found && right.found && on.found));
    CHECK(left.s_m == relative(x, 1e-9));
    CHECK(left.t_m == relative(23.0, 1e-9));
    CHECK(right.t_m == relative(-23.5, 1e-9));
    CHECK(left.outside_m == relative(20.0, 1e-3));
    CHECK(right.outside_m == relative(20.0, 1e-3));
    CHECK(on.outside_m == 0.0);
    CHECK(left.axis_z_m == relative(7.0, 1e-9));
    const auto surface_z = [&](double t_m) { return tilted().point(0, x, t_m).z; };
    CHECK(std::abs(left.edge_z_m - surface_z(3.0)) < 1e-3);
    CHECK(std::abs(right.edge_z_m - surface_z(-3.5)) < 1e-3);
    CHECK(std::abs(on.edge_z_m - surface_z(1.0)) < 1e-3);
  }
  CHECK(terrain.nearest({500.0, 502.0}).found);
  CHECK_FALSE(terrain.nearest({500.0, 504.0}).found);
}

TEST_CASE("height between two places of a graded road is between theirs") {
  road::SmallRoad file;
  file.profiles = "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0.1\" c=\"0\" d=\"0\"/></elevationProfile>";
  const auto network = road::read_or_fail(file.xml());
  const Terrain terrain(RoadShape(network, 0.0), 1);
  for (double x = 1.0; x < 99.0; x += 3.0) CHECK(std::abs(terrain.nearest({x, 10.0}).axis_z_m - 0.1 * x) < 1e-6);
}

TEST_CASE("the land lies 1.3 m under the road and 0.9 m under the edge of its lanes beside it") {
  const Terrain terrain(tilted(), 1);
  for (const double x : {100.0, 333.0, 800.0}) {
    for (const double y : {-3.4, -1.0, 0.0, 2.9})
      CHECK(std::abs(terrain.height_m({x, y}) - (tilted().point(0, x, y).z - 1.3)) < 1e-3);
    for (const double outside : {0.5, 4.0, 8.9}) {
      CHECK(std::abs(terrain.height_m({x, 3.0 + outside}) - (tilted().point(0, x, 3.0).z - 0.9)) < 1e-3);
      CHECK(std::abs(terrain.height_m({x, -3.5 - outside}) - (tilted().point(0, x, -3.5).z - 0.9)) < 1e-3);
    }
  }
}

TEST_CASE("the land is nowhere above the motorway but over its tunnel, which it covers") {
  const auto& tunnel = structure(road::RoadStructure::Kind::tunnel);
  const road::Road& road = road::motorway().roads[0];
  for (double s = 5.0; s < road.length_m; s += 40.0) {
    const road::RoadExtent extent = road::road_extent(road, s);
    for (const double share : {0.02, 0.5, 0.98}) {
      const Vec3 p = motorway_shape().point(0, s, std::lerp(extent.right_t_m, extent.left_t_m, share));
      const double over_m = motorway_land().height_m(Vec2(p)) - p.z;
      CAPTURE(s);
      CAPTURE(share);
      if (s > tunnel.s_m + 10.0 && s < tunnel.s_m + tunnel.length_m - 10.0)
        CHECK(over_m > 8.0);  // The ceiling is at 6.6 m.
      else if (s < tunnel.s_m - 10.0 || s > tunnel.s_m + tunnel.length_m + 10.0)
        CHECK(over_m < -0.5);
    }
  }
  const double middle_s_m = tunnel.s_m + 0.5 * tunnel.length_m;
  const Vec3 middle = motorway_shape().point(0, middle_s_m, 0.0);
  CHECK(motorway_land().height_m(Vec2(middle)) - middle.z >= 24.99);
}

TEST_CASE("a bridge crosses a valley of fifteen metres that goes on across the road") {
  const auto& bridge = structure(road::RoadStructure::Kind::bridge);
  const double s_m = bridge.s_m + 0.5 * bridge.length_m;
  const Vec3 middle = motorway_shape().point(0, s_m, 0.0);
  CHECK(std::abs(motorway_land().height_m(Vec2(middle)) - (middle.z - 1.3 - 15.0)) < 0.05);
  REQUIRE(motorway_land().valleys().size() == 1);
  const auto& valley = motorway_land().valleys().front();
  CHECK(glm::distance(valley.middle_m, middle) < 1e-6);
  CHECK(valley.bottom_z_m == doctest::Approx(middle.z - 16.0));
  // Meanders of its floor, beyond the bridge.
  const Vec2 across(-valley.along.y, valley.along.x);
  for (const double away_m : {-300.0, 250.0}) {
    const auto height_at = [&](double along_m) {
      return motorway_land().height_m(Vec2(middle) + away_m * across + along_m * valley.along);
    };
    const double floor_m = Terrain::meander_m(away_m);
    CHECK(std::abs(floor_m) > 2.0);
    CHECK(height_at(floor_m) < height_at(floor_m - 80.0) - 6.0);
    CHECK(height_at(floor_m) < height_at(floor_m + 80.0) - 6.0);
  }
  CHECK(Terrain::meander_m(29.0) == 0.0);
  CHECK(Terrain::meander_m(200.0) == doctest::Approx(14.0 * std::sin(200.0 / 85.0)));
}

TEST_CASE("nothing grows under a bridge or over a tunnel and the land breaks off at a portal") {
  const auto& tunnel = structure(road::RoadStructure::Kind::tunnel);
  const auto near = [](double s_m, double t_m) {
    return motorway_land().nearest(Vec2(motorway_shape().point(0, s_m, t_m)));
  };
  const double left_m = road::road_extent(road::motorway().roads[0], tunnel.s_m).left_t_m;
  CHECK(motorway_land().is_kept_clear(near(tunnel.s_m + 100.0, left_m + 25.0)));
  CHECK_FALSE(motorway_land().is_kept_clear(near(tunnel.s_m + 100.0, left_m + 35.0)));
  CHECK(motorway_land().is_kept_clear(near(tunnel.s_m - 25.0, 0.0)));
  CHECK_FALSE(motorway_land().is_kept_clear(near(tunnel.s_m - 35.0, 0.0)));
  CHECK(motorway_land().is_at_portal(near(tunnel.s_m + tunnel.length_m + 20.0, left_m + 40.0)));
  CHECK(motorway_land().is_at_portal(near(tunnel.s_m - 20.0, 0.0)));
  CHECK_FALSE(motorway_land().is_at_portal(near(tunnel.s_m - 34.0, 0.0)));
  CHECK_FALSE(motorway_land().is_at_portal(near(tunnel.s_m, left_m + 60.0)));
}

TEST_CASE("a smooth step is level at both ends and half way in the middle") {
  CHECK(smooth_step(2.0, 6.0, 1.0) == 0.0);
  CHECK(smooth_step(2.0, 6.0, 2.0) == 0.0);
  CHECK(smooth_step(2.0, 6.0, 3.0) == doctest::Approx(0.15625));
  CHECK(smooth_step(2.0, 6.0, 4.0) == doctest::Approx(0.5));
  CHECK(smooth_step(2.0, 6.0, 6.0) == 1.0);
  CHECK(smooth_step(2.0, 6.0, 9.0) == 1.0);
}

TEST_CASE("squares near a place are those whose middle is in reach and no square is listed twice") {
  const auto squares = squares_near({{5.0, 5.0}, {6.0, 5.0}, {-95.0, 5.0}}, 10.0, 12.0);
  for (std::size_t i = 0; i + 1 < squares.size(); ++i)
    CHECK(std::pair(squares[i].y, squares[i].x) < std::pair(squares[i + 1].y, squares[i + 1].x));
  for (std::int64_t y = -20; y < 20; ++y)
    for (std::int64_t x = -20; x < 20; ++x) {
      const Vec2 middle = (Vec2(static_cast<double>(x), static_cast<double>(y)) + 0.5) * 10.0;
      double least_m = 1e9;
      for (const Vec2& place : {Vec2(5.0, 5.0), Vec2(-95.0, 5.0)})
        least_m = std::min(least_m, std::max(std::abs(middle.x - place.x), std::abs(middle.y - place.y)));
      const bool is_listed = std::ranges::find(squares, glm::i64vec2(x, y)) != squares.end();
      CAPTURE(x);
      CAPTURE(y);
      if (least_m <= 12.0) CHECK(is_listed);
      if (least_m > 35.0) CHECK_FALSE(is_listed);
    }
}

TEST_CASE("no house stands nearer to a road than seventy-five metres, nor in a wood, and there are some") {
  // Nearly a ring: a place far enough from the road here may be too near to it there.
  road::SmallRoad bend{.length_m = 900.0, .geometry = "<arc curvature=\"0.0065\"/>"};
  const road::RoadNetwork network = road::read_or_fail(bend.xml());
  const RoadShape roads(network, 0.0);
  int houses = 0, near = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Terrain terrain(roads, seed);
    for (const Building& house : placed_buildings(roads, terrain, seed)) {
      const Vec2 at(house.world_from_building.position_m);
      ++houses;
      near += terrain.nearest(at).outside_m < 75.0;
      CHECK(terrain.woodland(at) <= 0.02);
    }
  }
  CHECK(houses > 10);
  CHECK(near == 0);
}

}  // namespace septet::roadside
