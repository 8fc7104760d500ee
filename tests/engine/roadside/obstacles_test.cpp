#include "engine/roadside/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/road/road_locate.hpp"
#include "engine/roadside/plants.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::roadside {
namespace {

const Obstacles& motorway_obstacles() {
  static const Obstacles obstacles(road::motorway(), 1);
  return obstacles;
}

Vec2 on_motorway(double s_m, double t_m) { return Vec2(road::evaluate(road::motorway(), {0, s_m, t_m}).position_m); }

std::vector<ObstacleKind> kinds_near(const Vec2& p, double reach_m) {
  std::vector<ObstacleKind> kinds;
  for (const Obstacle& obstacle : motorway_obstacles().near(p, reach_m)) kinds.push_back(obstacle.kind);
  return kinds;
}

}  // namespace

TEST_CASE("every kind of thing stands beside the motorway") {
  std::map<ObstacleKind, int> count;
  for (const Obstacle& obstacle : motorway_obstacles().listed()) ++count[obstacle.kind];
  for (int kind = 0; kind <= static_cast<int>(ObstacleKind::house); ++kind) {
    CAPTURE(name_of(static_cast<ObstacleKind>(kind)));
    CHECK(count[static_cast<ObstacleKind>(kind)] > 0);
  }
  CHECK(count[ObstacleKind::marker_post] > 200);
  CHECK(count[ObstacleKind::tree] > 1000);
}

TEST_CASE(
    "rails and the wall between the carriageways are found where the road file has them and nothing in the lanes") {
  for (const double s : {100.0, 901.5, 3100.0, 5500.0}) {
    CAPTURE(s);
    const auto middle = kinds_near(on_motorway(s, 0.0), 1.0);
    CHECK(!middle.empty());
    CHECK(std::ranges::count(middle, ObstacleKind::concrete_barrier) == static_cast<std::ptrdiff_t>(middle.size()));
    CHECK(std::ranges::count(kinds_near(on_motorway(s, 23.85), 1.0), ObstacleKind::guard_rail) > 0);
    for (const double t : {-3.0, -11.0, -20.0, 3.0, 20.0}) CHECK(kinds_near(on_motorway(s, t), 1.2).empty());
  }
}

TEST_CASE("a rail is one run without joints over kilometres and its loose ends are open") {
  std::map<std::uint32_t, std::vector<Obstacle>> runs;
  for (const Obstacle& obstacle : motorway_obstacles().listed())
    if (obstacle.kind == ObstacleKind::guard_rail) runs[obstacle.run].push_back(obstacle);
  std::size_t longest = 0;
  for (const auto& [run, stretches] : runs) {
    longest = std::max(longest, stretches.size());
    for (std::size_t i = 0; i + 1 < stretches.size(); ++i) {
      CHECK(glm::distance(stretches[i].to_m, stretches[i + 1].from_m) < 1e-9);
      CHECK_FALSE(stretches[i].open_to);
      CHECK_FALSE(stretches[i + 1].open_from);
    }
  }
  CHECK(longest > 200);
}

TEST_CASE("stems stand in the woods that are drawn and nowhere else") {
  const Terrain terrain(RoadShape(road::motorway(), usual_overrun_m), 1);
  int in_wood = 0, in_field = 0;
  double most_free_m = 0.0;
  for (double s = 100.0; s < 6000.0; s += 50.0)
    for (const double t : {-150.0, -100.0, 100.0, 150.0}) {
      const Vec2 p = on_motorway(s, t);
      const Vec2 cell = glm::floor(p / land_cell_m), middle = (cell + 0.5) * land_cell_m;
      const auto found = motorway_obstacles().near(middle, 5.0);
      if (!is_wood(terrain, middle, land_cell_m)) {
        in_field += static_cast<int>(
            std::ranges::count_if(found, [](const Obstacle& o) { return (o.run & 0x8000'0000u) != 0; }));
        continue;
      }
      ++in_wood;
      double nearest_m = INFINITY;
      for (const Obstacle& obstacle : found) nearest_m = std::min(nearest_m, glm::distance(obstacle.from_m, middle));
      most_free_m = std::max(most_free_m, nearest_m);
    }
  CHECK(in_wood > 20);
  CHECK(in_field == 0);
  CHECK(most_free_m < 4.0);
}

TEST_CASE("the same seed gives the same obstacles and another seed other trees") {
  const Obstacles again(road::motorway(), 1), other(road::motorway(), 2);
  const auto& first = motorway_obstacles();
  REQUIRE(again.listed().size() == first.listed().size());
  for (std::size_t i = 0; i < first.listed().size(); ++i) CHECK(again.listed()[i].from_m == first.listed()[i].from_m);
  CHECK(other.listed().size() != first.listed().size());
}

TEST_CASE("a road without anything beside it has nothing to hit on it") {
  CHECK(Obstacles(road::RoadNetwork{}, 1).near({0.0, 0.0}, 5.0).empty());
}

}  // namespace septet::roadside
