#include <cmath>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "tests/engine/scenery/world/drawn_world.hpp"
#include "tests/relative.hpp"

namespace septet::scenery {
namespace {

scene::Store road_with(const std::string& inside) {
  scene::Store store;
  scene::SceneBuilder builder(store);
  const std::string sections = "<laneSection s=\"0\"><left>" + road::lane(2, 2.0, "", "sidewalk") + road::lane(1, 3.5) +
                               "</left><center>" + road::lane(0, 0) + "</center><right>" + road::lane(-1, 3.5) +
                               road::lane(-2, 2.0, "", "sidewalk") + "</right></laneSection>";
  build_road_world(
      builder,
      road::read_or_fail(road::replaced(road::SmallRoad{.sections = sections}.xml(), "</lanes>", "</lanes>" + inside)),
      3, bare);
  return store;
}

/// Area of the paint that faces up, and its bounds in the world, which are the road's here.
struct Paint {
  double m2 = 0.0, down_m2 = 0.0;
  Vec3 low_m{1e9}, high_m{-1e9};
};
Paint paint(const scene::Store& store) {
  Paint result;
  for (const DrawnTriangle& triangle : drawn_triangles(store, "road paint")) {
    const double up = 0.5 * triangle.across().z;
    (up > 0.0 ? result.m2 : result.down_m2) += up;
    for (const Vec3& corner : triangle.corners_m) {
      result.low_m = glm::min(result.low_m, corner);
      result.high_m = glm::max(result.high_m, corner);
    }
  }
  return result;
}

}  // namespace

TEST_CASE("a crossing is bars from kerb to kerb, as an object and as a signal") {
  const Paint object = paint(road_with(
      "<objects><object id=\"1\" type=\"crosswalk\" s=\"50\" t=\"0\" length=\"4\" width=\"20\" hdg=\"0\"/></objects>"));
  const Paint signal =
      paint(road_with("<signals><signal id=\"1\" type=\"1000003\" s=\"20\" t=\"0\" width=\"20\" height=\"0.01\" "
                      "value=\"4\"/></signals>"));
  for (const Paint& crossing : {object, signal}) {
    CHECK(crossing.m2 == relative(7.0 * 0.5 * 4.0, 0.02));
    CHECK(crossing.down_m2 == 0.0);
    CHECK(crossing.low_m.y > -3.5);
    CHECK(crossing.high_m.y < 3.5);
    CHECK(crossing.high_m.x - crossing.low_m.x == relative(4.0, 0.01));
    CHECK(crossing.low_m.z > 0.005);
  }
  CHECK(object.low_m.x == relative(48.0, 0.001));
  CHECK(signal.low_m.x == relative(20.0, 0.001));
}

TEST_CASE("a row of parking spaces has its lines, but for the side from which one drives in") {
  const Paint spaces = paint(road_with(
      R"(<objects><object id="1" type="parkingSpace" s="20" t="-2.5" length="5" width="2" height="0"><repeat s="20" length="10" distance="5" tStart="-2.5" tEnd="-2.5" heightStart="0" heightEnd="0" zOffsetStart="0" zOffsetEnd="0"/></object></objects>)"));
  CHECK(spaces.m2 == relative(3.0 * 0.12 * (5.12 + 2 * 2.12), 0.02));
  CHECK(spaces.down_m2 == 0.0);
  CHECK(spaces.low_m.x == relative(17.44, 0.002));
  CHECK(spaces.high_m.x == relative(32.56, 0.002));
  CHECK(spaces.low_m.y == relative(-3.56, 0.002));
  CHECK(spaces.high_m.y < -1.4);
}

TEST_CASE("barriers of a file stand along their repeats, as high as it says, and as what it says") {
  const auto barrier = [](const std::string& type, const std::string& subtype, const std::string& rest) {
    scene::Store store = road_with("<objects><object id=\"1\" type=\"" + type + "\" subtype=\"" + subtype +
                                   "\" s=\"50\" t=\"4.5\" " + rest + "</object></objects>");
    Vec3 low(1e9), high(-1e9);
    for (const char* name : {"barriers", "posts"})
      for (const DrawnTriangle& triangle : drawn_triangles(store, name))
        for (const Vec3& corner : triangle.corners_m)
          if (corner.y > 4.0 && corner.y < 5.0) low = glm::min(low, corner), high = glm::max(high, corner);
    return std::pair(low, high);
  };
  const std::string repeat =
      R"(><repeat s="20" length="40" distance="0" tStart="4.5" tEnd="4.5" heightStart="HIGH" heightEnd="HIGH" zOffsetStart="0" zOffsetEnd="0"/>)";
  for (const auto& [subtype, high_m] : {std::pair("guardRail", "0.9"),
                                        {"jerseyBarrier", "1.4"},
                                        {"wall", "3.2"},
                                        {"fence", "1.2"},
                                        {"hedge", "0.8"},
                                        {"railing", "1.1"}}) {
    CAPTURE(subtype);
    const auto [low, high] =
        barrier("barrier", subtype, road::replaced(road::replaced(repeat, "HIGH", high_m), "HIGH", high_m));
    CHECK(high.z == relative(std::stod(high_m), 0.03));
    CHECK(low.z < 0.05);
    CHECK(low.x == relative(20.0, 0.01));
    CHECK(high.x == relative(60.0, 0.01));
  }
  // An object without repeats is as long as its length.
  const auto [low, high] = barrier("fence", "", R"(length="10" height="2">)");
  CHECK(low.x == relative(45.0, 0.01));
  CHECK(high.x == relative(55.0, 0.01));
  CHECK(high.z == relative(2.0, 0.03));
}

TEST_CASE("a stop line lies across the lanes that lead to it and no others") {
  const Paint along =
      paint(road_with("<signals><signal id=\"1\" type=\"294\" s=\"50\" t=\"0\" orientation=\"+\"/></signals>"));
  const Paint against =
      paint(road_with("<signals><signal id=\"1\" type=\"294\" s=\"50\" t=\"0\" orientation=\"-\"/></signals>"));
  CHECK(along.high_m.y < 0.0);
  CHECK(along.low_m.y > -3.5);
  CHECK(against.low_m.y > 0.0);
  CHECK(along.m2 == relative(0.5 * (3.5 - 0.16), 0.02));
}

TEST_CASE("paint looks up whichever way its arrow points") {
  for (const char* orientation : {"+", "-"})
    for (const char* name : {"SgRMArrowLeft", "SgRMArrowStraightRight", "SgRMArrowStraightLeft", "SgRMArrowRight"}) {
      const Paint arrow =
          paint(road_with("<signals><signal id=\"1\" type=\"-1\" name=\"" + std::string(name) +
                          "\" s=\"50\" t=\"-1.75\" height=\"0.03\" orientation=\"" + orientation + "\"/></signals>"));
      CHECK(arrow.m2 > 0.5);
      CHECK(arrow.down_m2 == 0.0);
    }
}

TEST_CASE("outlines and signals of any numbers leave the world finite") {
  const scene::Store store = road_with(
      "<objects><object id=\"1\" type=\"crosswalk\" s=\"50\" t=\"0\"><outline><cornerLocal u=\"0\" "
      "v=\"0\"/></outline></object>"
      "<object id=\"2\" type=\"crosswalk\" s=\"50\" t=\"0\" length=\"1e5\" width=\"900\"/>"
      "<object id=\"3\" type=\"crosswalk\" s=\"1e9\" t=\"-900\" length=\"4\" width=\"4\" hdg=\"1e9\"/></objects>"
      "<signals><signal id=\"1\" type=\"1000003\" s=\"100\" t=\"900\" width=\"0\" value=\"-1e9\"/>"
      "<signal id=\"2\" type=\"206\" s=\"50\" t=\"5\" zOffset=\"-900\" width=\"1e3\" height=\"1e-9\" "
      "hOffset=\"1e11\"/>"
      "<signal id=\"3\" type=\"1000001\" s=\"50\" t=\"5\" zOffset=\"900\" dynamic=\"yes\"/>"
      "<signal id=\"4\" type=\"310\" text=\"Llanfairpwllgwyngyllgogerychwyrndrobwll\" s=\"50\" t=\"5\"/></signals>");
  int wrong = 0;
  for (const char* name : {"road paint", "sign posts", "sign", "traffic light"})
    for (const DrawnTriangle& triangle : drawn_triangles(store, name))
      for (const Vec3& corner : triangle.corners_m) wrong += !(glm::length(corner) < 2000.0);
  CHECK(wrong == 0);
}

}  // namespace septet::scenery
