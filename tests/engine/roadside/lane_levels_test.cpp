#include "engine/roadside/lane_levels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/roadside/barrier_lines.hpp"
#include "engine/roadside/ground_beside.hpp"
#include "engine/roadside/terrain.hpp"
#include "tests/engine/road/crossing_roads.hpp"

namespace septet::roadside {

TEST_CASE("ground beside a lower lane rises no more steeply than 1 in 1.5 and not at all over it") {
  const road::RoadNetwork network = road::terraces(3.0, 5.0);
  const LaneLevels lanes(RoadShape(network, 0.0));
  // The lower road's left edge lies at y = 3.5, the upper one's right edge at 6.5.
  CHECK(lanes.limited_m({0.0, 2.0}, 5.0) < 0.31);
  CHECK(lanes.limited_m({0.0, 6.5}, 5.0) > 1.2);
  CHECK(lanes.limited_m({0.0, 6.5}, 5.0) < 0.3 + 3.1 / 1.5);
  CHECK(lanes.limited_m({0.0, 6.5}, -0.5) == -0.5);
  CHECK(lanes.limited_m({0.0, 60.0}, 5.0) == 5.0);
}

TEST_CASE("the land goes with the lower of two roads that cross and reaches over no lane") {
  for (const double up_m : {4.5, 6.0, 9.0}) {
    CAPTURE(up_m);
    const road::RoadNetwork network = road::two_levels(up_m);
    const Terrain terrain(RoadShape(network, 0.0), 1);
    CHECK(terrain.valleys().empty());
    for (double x = -190.0; x < 190.0; x += 1.0)
      for (const double y : {-3.4, 0.0, 3.4}) CHECK(terrain.height_m({x, y}) < -0.2);
    // The upper road's bank stands away from the crossing.
    CHECK(terrain.height_m({0.0, 60.0}) > up_m - 2.5);
  }
}

TEST_CASE("a wheel that leaves a lane below a deck stands on the ground and not on the deck") {
  const road::RoadNetwork network = road::two_levels();
  const RoadShape roads(network, 0.0);
  const Terrain terrain(roads, 1);
  const road::RoadPosition hint{0, 200.0, -3.4};
  const Vec2 beside{0.0, -4.5};  // The upper road's lanes hold it.
  const auto blind = road::surface_at(network, beside, &hint, 60.0);
  REQUIRE(blind.has_value());
  CHECK(blind->height_m == doctest::Approx(6.0));
  const auto seen = road::surface_at(network, beside, &hint, 60.0, 0.3);
  REQUIRE(seen.has_value());
  CHECK(seen->height_m == doctest::Approx(0.0));
  CHECK(seen->outside_m == doctest::Approx(1.0));
  const auto on_deck = road::surface_at(network, beside, &hint, 60.0, 6.3);
  REQUIRE(on_deck.has_value());
  CHECK(on_deck->height_m == doctest::Approx(6.0));
  const double ground_m = ground_beside(network, terrain, beside, &hint, 0.3).height_m;
  CHECK(ground_m > -1.5);
  CHECK(ground_m < 0.3);
}

TEST_CASE("a road that runs on beyond its file ends before other roads") {
  const road::RoadNetwork network =
      road::laid({{.id = "across", .x_m = 100.0, .y_m = -100.0, .heading_rad = 1.5707963, .pieces = {{200, 0}}},
                  {.id = "towards", .x_m = -100.0, .pieces = {{150, 0}}}});
  const RoadShape roads(network, 1500.0);
  CHECK(roads.begin_m(1) == -1500.0);
  CHECK(roads.end_m(1) > 150.0);
  CHECK(roads.end_m(1) < 150.0 + 50.0 - 3.5);
}

TEST_CASE("a deck that no file gives has railings along both of its edges") {
  const road::RoadNetwork network = road::two_levels();
  const RoadShape roads(network, 0.0);
  std::size_t left = 0, right = 0;
  for (const RoadTile& tile : roads.tiles(160.0))
    for (const Barrier& barrier : barriers(roads, tile)) {
      CHECK(tile.on_bridge);
      CHECK(barrier.form == BarrierForm::railing);
      ++(barrier.line.t0_m > 0.0 ? left : right);
      CHECK(std::abs(barrier.line.t0_m) > 5.5);
    }
  CHECK(left > 0);
  CHECK(left == right);
}

}  // namespace septet::roadside
