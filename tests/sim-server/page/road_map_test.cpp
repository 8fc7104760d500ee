#include <cmath>

#include <doctest/doctest.h>

#include "sim-server/page/road_map.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::page {
namespace {

/// A lane each way and a pavement, 1 km straight, then a quarter circle.
road::RoadNetwork bend() {
  const road::SmallRoad road{
      .length_m = 1157.0796,
      .sections = road::lane_section(road::left_lanes(1), road::right_lanes(1) + road::lane(-2, 2.0, "", "sidewalk")),
      .plan = road::plan_piece(0, 0, 0, 0, 1000) + road::plan_piece(1000, 1000, 0, 0, 157.0796, road::arc(0.01))};
  return road::read_or_fail(road.xml());
}

}  // namespace

TEST_CASE("the map's lines follow the road within their tolerance, with few points where it is straight") {
  const auto map = road_map(bend(), 0.15);
  std::size_t carriageways = 0;
  for (const auto& shape : map.shapes) {
    if (shape.kind == RoadMap::Kind::carriageway) ++carriageways;
    CHECK(shape.points_m.size() < 100);
    for (const Vec2& point : shape.points_m) {
      if (point.x < 1000.0) {
        CHECK(std::abs(point.y) < 3.501);
        continue;
      }
      const double radius_m = glm::length(point - Vec2(1000.0, 100.0));
      CHECK(radius_m > 96.4);
      CHECK(radius_m < 103.6);  // The pavement is not painted.
    }
  }
  CHECK(carriageways == 2);
}

TEST_CASE("a map that would be too large becomes coarser and keeps its ends") {
  const auto map = road_map(bend(), 0.01, 60);
  std::size_t points = 0;
  for (const auto& shape : map.shapes) points += shape.points_m.size();
  CHECK(points <= 60);
  CHECK(points >= 2 * map.shapes.size());
  CHECK(road_map({}).shapes.empty());
}

TEST_CASE("what is simplified lies no further off than the tolerance, however long the line") {
  std::vector<Vec2> wave;
  for (int i = 0; i < 5000; ++i) wave.push_back({i * 0.5, 20.0 * std::sin(i * 0.01)});
  const auto few = simplified(wave, 0.2);
  CHECK(few.size() < 400);
  std::size_t at = 0;
  for (const Vec2& point : wave) {
    while (at + 2 < few.size() && few[at + 1].x < point.x) ++at;
    const Vec2 along = glm::normalize(few[at + 1] - few[at]), away = point - few[at];
    CHECK(std::abs(along.x * away.y - along.y * away.x) <= 0.2 + 1e-9);
  }
  CHECK(simplified({}, 1.0).empty());
  CHECK(simplified(std::vector<Vec2>(50, Vec2(1, 1)), 1.0).size() == 2);
}

}  // namespace septet::page
