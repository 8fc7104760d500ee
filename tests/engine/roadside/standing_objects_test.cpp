#include "engine/roadside/standing_objects.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/roadside/obstacles.hpp"
#include "engine/roadside/plants.hpp"
#include "engine/roadside/street.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::roadside {
namespace {

road::RoadNetwork with_objects(const std::string& objects) {
  return road::read_or_fail(
      road::replaced(road::SmallRoad{}.xml(), "</lanes>", "</lanes><objects>" + objects + "</objects>"));
}

std::string object(const std::string& type, double s, double t, const std::string& more,
                   const std::string& inside = "") {
  return "<object id=\"1\" type=\"" + type + "\" s=\"" + std::to_string(s) + "\" t=\"" + std::to_string(t) + "\" " +
         more + ">" + inside + "</object>";
}

std::vector<StandingObject> standing(const std::string& objects) {
  return standing_objects(RoadShape(with_objects(objects), 0.0));
}

}  // namespace

TEST_CASE("a road file's buildings, lamps, trees, poles and obstacles stand where it says, as large as it says") {
  const road::RoadNetwork network = with_objects(
      object("building", 20, 15, R"(length="12" width="8" height="7")") + object("streetLamp", 30, 6, R"(height="6")") +
      object("tree", 40, -9, R"(height="11" radius="2")") + object("vegetation", 45, -9, R"(height="1.2")") +
      object("pole", 50, 5, R"(height="4" radius="0.1")") +
      object("obstacle", 60, 7, R"(length="2" width="1" height="1")"));
  const RoadShape roads(network, 0.0);
  const std::vector<StandingObject> objects = standing_objects(roads);
  REQUIRE(objects.size() == 6);
  using enum StandingKind;
  const StandingKind kinds[]{building, lamp, tree, bush, pole, block};
  for (std::size_t i = 0; i < 6; ++i) CHECK(objects[i].kind == kinds[i]);
  CHECK(objects[0].footprint_m.size() == 4);
  CHECK(glm::length(objects[0].footprint_m[1] - objects[0].footprint_m[0]) == doctest::Approx(12.0));
  CHECK(objects[0].height_m == doctest::Approx(7.0));
  CHECK(objects[4].radius_m == doctest::Approx(0.1));
  const auto foot = [&](std::size_t i) { return objects[i].world_from_object.position_m; };
  CHECK(glm::length(foot(0) - roads.point(0, 20, 15)) < 1e-6);
  // Arm of the lamp over the road; no other lamps are generated.
  REQUIRE(street_lamps(roads).size() == 1);
  CHECK(glm::length(street_lamps(roads)[0].world_from_lamp * Vec3(6, 0, 0) - roads.point(0, 30, 0)) < 0.01);
  // Vehicles run against them, and the tree is planted.
  const Obstacles obstacles(network, 3);
  const auto hit = [&](std::size_t i, ObstacleKind kind) {
    return std::ranges::any_of(obstacles.near(Vec2(foot(i)), 8.0), [&](const Obstacle& o) { return o.kind == kind; });
  };
  CHECK(hit(0, ObstacleKind::house));
  CHECK(hit(1, ObstacleKind::post));
  CHECK(hit(2, ObstacleKind::tree));
  CHECK(hit(4, ObstacleKind::post));
  CHECK(hit(5, ObstacleKind::house));
}

TEST_CASE("an outline is a building's shape against the clock whichever way its corners run") {
  const std::string corners =
      R"(<outline><cornerLocal u="-5" v="-3" z="0" height="8"/><cornerLocal u="-5" v="3" z="0" height="8"/>
<cornerLocal u="5" v="3" z="0" height="8"/><cornerLocal u="5" v="0" z="0" height="8"/><cornerLocal u="0" v="-3" z="0" height="8"/></outline>)";
  const std::vector<StandingObject> objects = standing(object("building", 20, 15, R"(height="8")", corners));
  REQUIRE(objects.size() == 1);
  REQUIRE(objects[0].footprint_m.size() == 5);
  double twice_area = 0.0;
  for (std::size_t i = 0; i < 5; ++i) {
    const Vec2 &a = objects[0].footprint_m[i], &b = objects[0].footprint_m[(i + 1) % 5];
    twice_area += a.x * b.y - b.x * a.y;
  }
  CHECK(twice_area == doctest::Approx(2.0 * (60.0 - 7.5)));
}

TEST_CASE(
    "a row of poles stands along its repeat, and what is paint, a kerb, a barrier or of no size is nothing here") {
  CHECK(
      standing(
          object(
              "pole", 10, 5, R"(height="4" radius="0.1")",
              R"(<repeat s="10" length="40" distance="10" tStart="5" tEnd="5" heightStart="4" heightEnd="4" zOffsetStart="0" zOffsetEnd="0" widthStart="0.2" widthEnd="0.2"/>)"))
          .size() == 5);
  const std::vector<StandingObject> walls = standing(object(
      "barrier", 10, 5, R"(subtype="wall" width="0.4" height="2")",
      R"(<outlines><outline closed="false"><cornerLocal u="0" v="0" z="0"/><cornerLocal u="0" v="8" z="0"/></outline></outlines>)"));
  REQUIRE(walls.size() == 1);
  CHECK(walls[0].kind == StandingKind::block);
  CHECK(walls[0].height_m == 2.0);
  REQUIRE(walls[0].footprint_m.size() == 4);
  CHECK(std::abs(walls[0].footprint_m[0].x) == doctest::Approx(0.2));
  CHECK(standing(object("guide-post", 10, 5, R"(height="1")")).size() == 1);
  CHECK(standing(object("barrier", 10, 5, R"(length="20" height="0.8")")).empty());
  CHECK(standing(object("crosswalk", 10, 0, R"(length="4" width="7" height="0")")).empty());
  CHECK(standing(object("obstacle", 10, 5, R"(name="kerb" length="4" width="0.2" height="0.1")")).empty());
  CHECK(standing(object("parkingSpace", 10, 5, R"(length="5" width="2.5")")).empty());
  CHECK(standing(object("building", 10, 25, R"(height="8")")).empty());
  CHECK(standing(object("building", 10, 25, R"(length="5000" width="10" height="8")")).empty());
}

}  // namespace septet::roadside
