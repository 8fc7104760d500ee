#include "engine/road/road_locate.hpp"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "road_files.hpp"
#include "tests/relative.hpp"

namespace septet::road {
namespace {

RoadPosition random_position(const RoadNetwork& network, Random& random) {
  const auto road = static_cast<RoadIndex>(random.below(network.roads.size()));
  const double s = random.uniform(0.01, network.roads[road].length_m - 0.01);
  const RoadExtent extent = road_extent(network.roads[road], s);
  return {road, s, random.uniform(extent.right_t_m + 0.01, extent.left_t_m - 0.01)};
}

}  // namespace

TEST_CASE("locating a random point of the motorway gives back its road and station and offset") {
  const RoadNetwork& network = motorway();
  Random random(1);
  for (int i = 0; i < 5000; ++i) {
    const RoadPosition position = random_position(network, random);
    const Vec3 point = evaluate(network, position).position_m;
    const RoadPosition hint{position.road, position.s_m + random.uniform(-5.0, 5.0), 0.0};
    const auto found = locate(network, Vec2(point), &hint);
    REQUIRE(found.has_value());
    REQUIRE(found->position.road == position.road);
    REQUIRE(found->position.s_m == relative(position.s_m, 1e-9));
    REQUIRE(found->position.t_m == relative(position.t_m, 1e-9));
    REQUIRE(found->lanes.outside_m == 0.0);

    const auto cold = locate(network, Vec2(point));
    REQUIRE(cold.has_value());
    REQUIRE(glm::distance(evaluate(network, cold->position).position_m, point) < 1e-6);
  }
}

TEST_CASE("steep banking on a changing grade is inverted exactly") {
  SmallRoad road{.length_m = 200.0, .geometry = "<arc curvature=\"0.01\"/>"};
  road.profiles =
      "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0\" c=\"0.002\" "
      "d=\"-5e-6\"/></elevationProfile>"
      "<lateralProfile><superelevation s=\"0\" a=\"0.1\" b=\"0.003\" c=\"0\" "
      "d=\"0\"/></lateralProfile>";
  const RoadNetwork network = read_or_fail(road.xml());
  Random random(2);
  for (int i = 0; i < 2000; ++i) {
    const RoadPosition position{0, random.uniform(5.0, 195.0), random.uniform(-3.4, 2.9)};
    const auto found = locate(network, Vec2(evaluate(network, position).position_m));
    REQUIRE(found.has_value());
    REQUIRE(found->position.s_m == relative(position.s_m, 1e-8));
    REQUIRE(found->position.t_m == relative(position.t_m, 1e-8));
  }
}

TEST_CASE("beside the road the nearest lane is found and far away none") {
  const RoadNetwork network = read_or_fail(SmallRoad{}.xml());
  const auto beside = locate(network, {50.0, -8.5});
  REQUIRE(beside.has_value());
  CHECK(beside->lanes.lane == -1);
  CHECK(beside->lanes.outside_m == doctest::Approx(5.0));
  const auto beyond = locate(network, {103.0, 1.0});
  REQUIRE(beyond.has_value());
  CHECK(beyond->position.s_m == 100.0);
  CHECK(beyond->lanes.outside_m == doctest::Approx(3.0));
  CHECK_FALSE(locate(network, {50.0, 1000.0}).has_value());
  CHECK_FALSE(locate(network, {std::nan(""), 0.0}).has_value());
  CHECK_FALSE(locate(network, {1e300, -1e300}).has_value());
}

TEST_CASE("a vehicle that leaves its road by the end is found on the linked road") {
  const RoadNetwork& network = motorway();
  const RoadIndex first = *find_road(network, "1"), second = *find_road(network, "2"), ramp = *find_road(network, "11");
  const double length = network.roads[first].length_m;
  const RoadPosition hint{first, length - 0.1, -20.0};
  const Vec3 on_main = evaluate_lane(network, {second, -5, 1.0, 0.0}).road.position_m;
  const auto main = locate(network, Vec2(on_main), &hint);
  REQUIRE(main.has_value());
  CHECK(main->position.road == second);
  CHECK(main->lanes.lane == -5);
  const Vec3 on_ramp = evaluate_lane(network, {ramp, -1, 1.0, 0.0}).road.position_m;
  const auto exit = locate(network, Vec2(on_ramp), &hint);
  REQUIRE(exit.has_value());
  CHECK(exit->position.road == ramp);
  CHECK(exit->lanes.lane == -1);
}

TEST_CASE("the normal of the surface is that of the points around it") {
  Random random(3);
  const RoadNetwork& network = motorway();
  for (int i = 0; i < 300; ++i) {
    RoadPosition position = random_position(network, random);
    position.s_m = std::min(position.s_m, network.roads[position.road].length_m - 0.2);
    const Vec2 at(evaluate(network, position).position_m);
    const auto surface = surface_at(network, at, &position);
    REQUIRE(surface.has_value());
    const auto east = surface_at(network, at + Vec2(0.005, 0.0), &position);
    const auto north = surface_at(network, at + Vec2(0.0, 0.005), &position);
    if (!east || !north) continue;
    const Vec3 u(0.005, 0.0, east->height_m - surface->height_m), v(0.0, 0.005, north->height_m - surface->height_m);
    REQUIRE(glm::distance(surface->normal, glm::normalize(glm::cross(u, v))) < 1e-4);
  }
}

TEST_CASE("a banked road with a shape and a crossfall and raised lanes is inverted exactly") {
  SmallRoad road{.length_m = 200.0, .geometry = "<arc curvature=\"0.01\"/>"};
  road.profiles =
      "<lateralProfile><superelevation s=\"0\" a=\"0.2\" b=\"0.001\" c=\"0\" d=\"0\"/>"
      "<crossfall side=\"both\" s=\"0\" a=\"0.03\" b=\"0\" c=\"0\" d=\"0\"/>"
      "<shape s=\"0\" t=\"0\" a=\"0.1\" b=\"0.05\" c=\"0\" d=\"0\"/></lateralProfile>";
  road.sections = "<laneSection s=\"0\"><left>" + lane(1, 3.0) + "</left><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 3.5, "<height sOffset=\"0\" inner=\"0.4\" outer=\"0.6\"/>") + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  Random random(4);
  for (int i = 0; i < 500; ++i) {
    const RoadPosition position{0, random.uniform(5.0, 195.0), random.uniform(-3.4, 2.9)};
    const auto found = locate(network, Vec2(evaluate(network, position).position_m));
    REQUIRE(found.has_value());
    REQUIRE(found->position.s_m == relative(position.s_m, 1e-8));
    REQUIRE(found->position.t_m == relative(position.t_m, 1e-7));
  }
}

TEST_CASE("beyond the end the connecting road is chosen whose lane is nearer to the point") {
  const auto connecting = [](const char* id, double width_m) {
    return SmallRoad{.length_m = 50.0,
                     .sections = lane_section("", lane(-1, width_m)),
                     .id = id,
                     .junction = "7",
                     .link = link_to_road("predecessor", "a", "end"),
                     .x_m = 100.0}
        .text();
  };
  // Both hold the points from y = -3 to 0; the middle of b is at -1.75, that of c at -4.
  const std::string xml = roads_text(SmallRoad{.link = link_to_junction("successor", "7")}.text() +
                                     connecting("b", 3.5) + connecting("c", 8.0) + "<junction id=\"7\">" +
                                     connection("b", "a", "b") + connection("c", "a", "c") + "</junction>");
  const RoadNetwork network = read_or_fail(xml);
  const RoadPosition hint{0, 99.0, -1.75};
  const auto near_b = locate(network, {103.0, -1.5}, &hint), near_c = locate(network, {103.0, -3.4}, &hint);
  REQUIRE(near_b.has_value());
  REQUIRE(near_c.has_value());
  CHECK(network.roads[near_b->position.road].id == "b");
  CHECK(network.roads[near_c->position.road].id == "c");
}

TEST_CASE("where a road and a connecting road hold a point the road answers") {
  const SmallRoad over{.sections = lane_section("", lane(-1, 3.5)), .id = "b", .junction = "7", .y_m = 1.0};
  const RoadNetwork network = read_or_fail(roads_text(SmallRoad{}.text() + over.text() + "<junction id=\"7\"/>"));
  REQUIRE(network.roads.size() == 2);
  // In the middle of the connecting road's lane, and still in that of the other.
  const auto found = locate(network, {50.0, -0.75});
  REQUIRE(found.has_value());
  CHECK(found->lanes.outside_m == 0.0);
  CHECK(network.roads[found->position.road].junction == no_index);
}

TEST_CASE("a raised lane rises evenly from its inner height to its outer one") {
  SmallRoad road{.length_m = 100.0};
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 4.0, "<height sOffset=\"0\" inner=\"0.4\" outer=\"0.6\"/>") + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  for (const double share : {0.01, 0.25, 0.5, 0.75, 0.99}) {
    CAPTURE(share);
    CHECK(evaluate(network, {0, 50.0, -4.0 * share}).position_m.z == doctest::Approx(0.4 + 0.2 * share));
  }
}

TEST_CASE("the normal of the surface is that of its own side of a step, as near to it as one likes") {
  const auto cubic = [](const std::string& name, double s_m, double a, const std::string& more = "") {
    return "<" + name + " s=\"" + std::to_string(s_m) + "\" a=\"" + std::to_string(a) + "\" b=\"0\" c=\"0\" d=\"0\" " +
           more + "/>";
  };
  const std::string twisted =
      "<lateralProfile>" + cubic("superelevation", 0, 0.0) + cubic("superelevation", 40, 0.05) + "</lateralProfile>";
  const std::string shaped =
      "<lateralProfile>" + cubic("shape", 0, 0.0, "t=\"-5\"") + cubic("shape", 0, 0.1, "t=\"1\"") + "</lateralProfile>";
  const auto is_level = [](const std::string& profiles, double s_m, double t_m) {
    SmallRoad road{.length_m = 100.0};
    road.profiles = profiles;
    const RoadNetwork network = read_or_fail(road.xml());
    const RoadPosition position{0, s_m, t_m};
    return surface_at(network, Vec2(evaluate(network, position).position_m), &position)->normal.z > 0.998;
  };
  for (const double before_m : {1e-4, 1e-3, 5e-3, 9e-3, 0.02}) {
    CAPTURE(before_m);
    CHECK(is_level(twisted, 40.0 - before_m, -2.0));
    CHECK(is_level(twisted, 40.0 + before_m, -2.0));
    CHECK(is_level(shaped, 50.0, 1.0 - before_m));
    CHECK(is_level(shaped, 50.0, 1.0 + before_m));
  }
}

TEST_CASE("on the inside of a climbing bend the surface is steeper than the reference line") {
  SmallRoad road{.length_m = 40.0, .geometry = "<arc curvature=\"0.04\"/>"};
  road.profiles = "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0.1\" c=\"0\" d=\"0\"/></elevationProfile>";
  road.sections = "<laneSection s=\"0\"><left>" + lane(1, 12.0) + "</left><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 12.0) + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  for (const double t : {-10.0, 0.0, 10.0}) {
    const RoadPosition position{0, 20.0, t};
    const Vec2 at(evaluate(network, position).position_m);
    const auto height_at = [&](const Vec2& offset) { return surface_at(network, at + offset, &position)->height_m; };
    const double h = 1e-3;
    const Vec3 by_differences = glm::normalize(Vec3((height_at({-h, 0.0}) - height_at({h, 0.0})) / (2 * h),
                                                    (height_at({0.0, -h}) - height_at({0.0, h})) / (2 * h), 1.0));
    CHECK(glm::distance(surface_at(network, at, &position)->normal, by_differences) < 1e-6);
  }
}

}  // namespace septet::road
