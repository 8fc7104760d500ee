#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "sim-server/page/road_map.hpp"

namespace septet::page {
namespace {

/// Two lanes each way, 1 km straight, then a quarter circle.
road::RoadNetwork bend() {
  constexpr std::string_view text = R"(<OpenDRIVE><header revMajor="1" revMinor="8"/>
    <road name="" length="1157.0796" id="1" junction="-1"><planView>
      <geometry s="0" x="0" y="0" hdg="0" length="1000"><line/></geometry>
      <geometry s="1000" x="1000" y="0" hdg="0" length="157.0796"><arc curvature="0.01"/></geometry></planView>
    <lanes><laneSection s="0">
      <left><lane id="1" type="driving" level="false"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane></left>
      <center><lane id="0" type="none" level="false"/></center>
      <right><lane id="-1" type="driving" level="false"><width sOffset="0" a="3.5" b="0" c="0" d="0"/></lane>
        <lane id="-2" type="sidewalk" level="false"><width sOffset="0" a="2" b="0" c="0" d="0"/></lane></right>
    </laneSection></lanes></road></OpenDRIVE>)";
  auto network = road::read_opendrive(text, "test");
  REQUIRE(network.has_value());
  return std::move(*network);
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
