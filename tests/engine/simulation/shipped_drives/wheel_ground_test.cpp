#include "engine/simulation/wheel_ground.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/simulation/server_step.hpp"
#include "engine/simulation/step_edges.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

/// 200 m straight along x, one lane each way, with the given road objects.
road::RoadNetwork straight_road(const std::string& objects) {
  return road::read_or_fail(road::SmallRoad{.length_m = 200.0,
                                            .sections = road::lane_section(road::left_lanes(1), road::right_lanes(1)),
                                            .after_lanes = "<objects>" + objects + "</objects>"}
                                .xml());
}

double friction_at(const road::RoadNetwork& roads, const RoadWeather& weather, double x_m, double y_m) {
  vehicle::WheelGround wheel;
  road::RoadPosition place;
  REQUIRE(find_wheel_ground(roads, nullptr, weather, {x_m, y_m, 0.3}, false, place, wheel).has_value());
  return wheel.friction;
}

/// The motorway with nothing on it and nothing beside it but the driver's car.
struct EmptyMotorway {
  Model model = *server::shipped_drive("behind-ambulance", "desktop").model;
  State state;

  EmptyMotorway() {
    model.obstacles = nullptr;
    auto begun = initial_state(model, traffic::own_traffic(model.roads, 1));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    state.traffic->stop();
  }
  EmptyMotorway(const EmptyMotorway&) = delete;  // The traffic looks at the roads.
};

}  // namespace

TEST_CASE("a patch of ice lies under one wheel and not under the others") {
  const auto roads = straight_road(
      "<object id=\"1\" type=\"patch\" s=\"50\" t=\"-1\" length=\"2\" width=\"0.8\" hdg=\"0\"><material "
      "surface=\"ice\"/></object>");
  const RoadWeather frost{.temperature_k = 268.15};
  const double ice = vehicle::peak_friction(vehicle::SurfaceKind::ice, frost.temperature_k);
  CHECK(friction_at(roads, frost, 50.0, -1.0) == doctest::Approx(ice));
  CHECK(friction_at(roads, frost, 50.0, -2.6) == doctest::Approx(0.9));
  CHECK(friction_at(roads, frost, 47.2, -1.0) == doctest::Approx(0.9));
  CHECK(friction_at(roads, frost, 47.2, -2.6) == doctest::Approx(0.9));
}

TEST_CASE("weather and the scenario's friction scale act on the whole road and thaw on its ice") {
  const auto roads = straight_road(
      "<object id=\"1\" type=\"patch\" s=\"50\" t=\"-1\" length=\"2\" width=\"0.8\" hdg=\"0\">"
      "<material surface=\"ice\" friction=\"0.12\"/></object>");
  CHECK(friction_at(roads, {.wetness = 1.0}, 20.0, -1.0) == doctest::Approx(0.55));
  CHECK(friction_at(roads, {.wetness = 1.0, .friction_scale = 0.5}, 20.0, -1.0) == doctest::Approx(0.275));
  CHECK(friction_at(roads, {.temperature_k = 268.15}, 50.0, -1.0) == doctest::Approx(0.12));
  CHECK(friction_at(roads, {.temperature_k = 273.15}, 50.0, -1.0) < 0.08);
  CHECK(friction_at(roads, {.snow_cover = 1.0, .temperature_k = 253.15}, 20.0, -1.0) == doctest::Approx(0.35));
}

TEST_CASE("far from every road there is no surface to find") {
  const auto roads = straight_road("");
  vehicle::WheelGround wheel;
  road::RoadPosition place;
  CHECK_FALSE(find_wheel_ground(roads, nullptr, {}, {50.0, 500.0, 0.3}, false, place, wheel).has_value());
}

namespace {

/// The edge before a wheel or, where there is none, behind it.
std::optional<Vec3> place_of_edge(const vehicle::WheelGround& wheel) {
  for (const auto& edge : wheel.edges)
    if (edge) return edge->point_m;
  return std::nullopt;
}

}  // namespace

TEST_CASE("a wheel that comes to a kerb is told where its edge is and on the road there is none") {
  const road::SmallRoad with_kerb{
      .length_m = 200.0,
      .sections = road::lane_section(
          "", road::lane(-1, 3.5) +
                  road::lane(-2, 3.5, "", "sidewalk", "<height sOffset=\"0\" inner=\"0.12\" outer=\"0.12\"/>"))};
  const road::RoadNetwork roads = road::read_or_fail(with_kerb.xml());
  const auto edge = [&](const Vec3& centre_m, const Vec2& ahead) {
    vehicle::WheelGround wheel;
    road::RoadPosition place;
    REQUIRE(find_wheel_ground(roads, nullptr, {}, centre_m, false, place, wheel).has_value());
    find_step_edges(roads, nullptr, centre_m, ahead, 0.32, place, wheel);
    return place_of_edge(wheel);
  };
  CHECK_FALSE(edge({50.0, -2.0, 0.3}, {0.0, -1.0}).has_value());
  const auto before = edge({50.0, -3.3, 0.3}, {0.0, -1.0});
  REQUIRE(before.has_value());
  CHECK(before->y == relative(-3.5, 0.001));
  CHECK(before->z == relative(0.12, 0.01));
  const auto across = edge({50.0, -3.4, 0.3}, {0.8, -0.6});
  REQUIRE(across.has_value());
  CHECK(across->y == relative(-3.5, 0.001));
  const auto backwards = edge({50.0, -3.3, 0.3}, {0.0, 1.0});  // The car rolls back at it.
  REQUIRE(backwards.has_value());
  CHECK_FALSE(edge({50.0, -3.3, 0.3}, {1.0, 0.0}).has_value());   // Along the kerb.
  CHECK_FALSE(edge({50.0, -3.7, 0.4}, {0.0, -1.0}).has_value());  // Up on it the way goes on level.
}

TEST_CASE("an island and a kerb stone that are objects are met as kerbs and paint and walls are not") {
  const auto roads = straight_road(
      "<object id=\"1\" type=\"trafficIsland\" subtype=\"island\" s=\"50\" t=\"0\"><outlines><outline id=\"0\">"
      "<cornerRoad s=\"50\" t=\"0\" dz=\"0\" height=\"0.12\"/><cornerRoad s=\"55\" t=\"0\" dz=\"0\" height=\"0.12\"/>"
      "<cornerRoad s=\"56\" t=\"0\" dz=\"0\" height=\"0.01\"/><cornerRoad s=\"60\" t=\"0\" dz=\"0\" height=\"0.01\"/>"
      "<cornerRoad s=\"60\" t=\"2\" dz=\"0\" height=\"0.01\"/><cornerRoad s=\"56\" t=\"2\" dz=\"0\" height=\"0.01\"/>"
      "<cornerRoad s=\"55\" t=\"2\" dz=\"0\" height=\"0.12\"/><cornerRoad s=\"50\" t=\"2\" dz=\"0\" height=\"0.12\"/>"
      "</outline></outlines><borders><border outlineId=\"0\" type=\"curb\" width=\"0.1\"/></borders></object>"
      "<object id=\"2\" type=\"barrier\" name=\"Curb\" s=\"80\" t=\"-2\" height=\"0.1\" width=\"0.15\">"
      "<repeat s=\"80\" length=\"30\" distance=\"0\" tStart=\"-2\" tEnd=\"-2\" heightStart=\"0.1\" heightEnd=\"0.1\" "
      "widthStart=\"0.15\" widthEnd=\"0.15\"/></object>"
      "<object id=\"3\" type=\"none\" name=\"kerb at a bus stop\" s=\"130\" t=\"2\" height=\"0.2\" length=\"4\" "
      "width=\"1\" hdg=\"1.5707963\"/>"
      "<object id=\"4\" type=\"roadMark\" name=\"curb\" s=\"20\" t=\"2\" height=\"0.1\" length=\"4\" width=\"1\"/>"
      "<object id=\"5\" type=\"trafficIsland\" s=\"30\" t=\"2\" height=\"0.8\" length=\"4\" width=\"1\"/>");
  const roadside::RaisedAreas raised(roads);
  CHECK(raised.complete());
  struct Met {
    double height_m;
    std::optional<Vec3> edge_m;
  };
  const auto met = [&](double x_m, double y_m, const Vec2& ahead) {
    vehicle::WheelGround wheel;
    road::RoadPosition place;
    REQUIRE(find_wheel_ground(roads, &raised, {}, {x_m, y_m, 0.3}, false, place, wheel).has_value());
    find_step_edges(roads, &raised, {x_m, y_m, 0.3}, ahead, 0.32, place, wheel);
    return Met{wheel.point_m.z, place_of_edge(wheel)};
  };
  const Vec2 along(1.0, 0.0), left(0.0, 1.0);
  CHECK(met(52.0, 1.0, along).height_m == doctest::Approx(0.12));
  CHECK(met(58.0, 1.0, along).height_m == doctest::Approx(0.01));
  CHECK(met(55.5, 0.3, along).height_m == doctest::Approx(0.065));
  CHECK(met(52.0, -0.5, along).height_m == 0.0);
  const Met island = met(49.8, 1.0, along);
  CHECK(island.height_m == 0.0);
  REQUIRE(island.edge_m.has_value());
  CHECK(island.edge_m->x == relative(50.0, 0.0001));
  CHECK(island.edge_m->z == doctest::Approx(0.12));
  CHECK_FALSE(met(58.0, -0.2, left).edge_m.has_value());  // Lowered for those on foot.
  CHECK_FALSE(met(49.5, 1.0, along).edge_m.has_value());
  // 15 cm of stone, all within the wheel's radius: its near edge is the one.
  CHECK(met(95.0, -2.0, left).height_m == doctest::Approx(0.1));
  for (const double before_m : {0.05, 0.15, 0.3}) {
    CAPTURE(before_m);
    const Met stone = met(95.0, -2.075 - before_m, left);
    CHECK(stone.height_m == 0.0);
    REQUIRE(stone.edge_m.has_value());
    CHECK(stone.edge_m->y == relative(-2.075, 0.001));
  }
  CHECK(met(130.0, 3.9, along).height_m == doctest::Approx(0.2));  // The box stands across the road.
  CHECK(met(131.0, 2.0, along).height_m == 0.0);
  CHECK(met(20.0, 2.0, along).height_m == 0.0);
  CHECK(met(30.0, 2.0, along).height_m == 0.0);
}

TEST_CASE("an island of more corners than can be met in a tick is left out and said") {
  for (const int corners : {1'000, 1'001, 100'000}) {
    CAPTURE(corners);
    std::string round;
    for (int i = 0; i < corners; ++i)
      round += fmt::format("<cornerLocal u=\"{:.6f}\" v=\"{:.6f}\" z=\"0\" height=\"0.1\"/>",
                           2.0 * std::cos(6.2831853 * i / corners), 2.0 * std::sin(6.2831853 * i / corners));
    const auto roads =
        straight_road("<object id=\"1\" type=\"trafficIsland\" s=\"50\" t=\"0\"><outlines><outline id=\"0\">" + round +
                      "</outline></outlines></object>");
    const roadside::RaisedAreas raised(roads);
    CHECK(raised.complete() == (corners == 1'000));
    CHECK(raised.ground_at({50.0, 0.0}, 0.0) == (corners == 1'000 ? doctest::Approx(0.1) : doctest::Approx(0.0)));
  }
}

TEST_CASE("a car that crosses a kerb climbs it and the log has each wheel's touch with height and speed") {
  // The surface right of the car's own lane is raised, as lanes or as an object: a pavement along the motorway.
  for (const bool as_object : {false, true}) {
    CAPTURE(as_object);
    EmptyMotorway motorway;
    Model& model = motorway.model;
    State& state = motorway.state;
    Snapshot now = capture_snapshot(model, state);
    const int lane = now.driver_car.lane;
    REQUIRE(lane < 0);
    road::Road& road = model.roads.roads[now.driver_car.road];
    const RigidTransform start = find_participant(now, driver_participant)->world_from_vehicle;
    if (as_object) {
      const auto place = road::locate(model.roads, Vec2(start.position_m));
      REQUIRE(place.has_value());
      const double edge_t_m =
          place->position.t_m - now.driver_car.lateral_position_m - 0.5 * now.driver_car.lane_width_m;
      road::RoadObject kerb;
      kerb.type = "none";
      kerb.name = "kerb";
      kerb.repeats = {{.s_m = place->position.s_m - 10.0,
                       .length_m = 100.0,
                       .t_start_m = edge_t_m - 3.0,
                       .t_end_m = edge_t_m - 3.0,
                       .width_start_m = 6.0,
                       .width_end_m = 6.0,
                       .height_start_m = 0.1,
                       .height_end_m = 0.1}};
      road.objects.push_back(kerb);
      model.raised = std::make_shared<const roadside::RaisedAreas>(model.roads);
    } else {
      road.flat = false;
      for (road::LaneSection& section : road.sections)
        for (road::Lane& other : section.lanes)
          if (other.id < lane) other.heights = {{section.s_m, 0.1, 0.1}};
    }
    const Quat to_the_right = glm::angleAxis(-0.5, Vec3(0.0, 0.0, 1.0));
    state.car = vehicle::standstill(model.car, {start * Vec3(0.0, 0.6, 0.0), to_the_right * start.orientation}, 8.0);
    std::vector<Event> events;
    for (int tick = 0; tick < 240; ++tick) now = server_step(model, {}, state, events);
    std::vector<std::string> touches;
    for (const Event& event : events)
      if (event.kind == "kerb") touches.push_back(event.detail);
    REQUIRE(touches.size() >= 4);
    CHECK(touches[0].find("wheel=front_right height_m=0.1") == 0);
    for (const char* wheel : {"front_left", "rear_right", "rear_left"})
      CHECK(
          std::ranges::any_of(touches, [&](const std::string& text) { return text.find(wheel) != std::string::npos; }));
    CHECK(touches[0].find("speed_mps=7.") != std::string::npos);
    CHECK(now.diagnostics.bad_numbers == 0);
    CHECK(now.driver_car.lane < lane);
    CHECK(now.driver_car.speed_mps > 4.0);
  }
}

TEST_CASE("a kerb struck square at 15 m/s damages both front wheels and the log tells each once and at 2 m/s none") {
  for (const double speed_mps : {15.0, 2.0}) {
    CAPTURE(speed_mps);
    EmptyMotorway motorway;
    Model& model = motorway.model;
    State& state = motorway.state;
    const Snapshot before = capture_snapshot(model, state);
    const RigidTransform start = find_participant(before, driver_participant)->world_from_vehicle;
    const auto place = road::locate(model.roads, Vec2(start.position_m));
    REQUIRE(place.has_value());
    road::RoadObject kerb;  // Across the whole road, its edge some metres before the front axle.
    kerb.type = "none";
    kerb.name = "kerb";
    kerb.repeats = {{.s_m = place->position.s_m + 8.0,
                     .length_m = 100.0,
                     .t_start_m = place->position.t_m,
                     .t_end_m = place->position.t_m,
                     .width_start_m = 12.0,
                     .width_end_m = 12.0,
                     .height_start_m = 0.12,
                     .height_end_m = 0.12}};
    model.roads.roads[place->position.road].objects.push_back(kerb);
    model.raised = std::make_shared<const roadside::RaisedAreas>(model.roads);
    state.car = vehicle::standstill(model.car, start, speed_mps);
    DriverInput rolling;
    rolling.selector = GearSelector::neutral;
    std::vector<Event> events;
    for (int tick = 0; tick < (speed_mps > 10.0 ? 120 : 480); ++tick) server_step(model, rolling, state, events);
    const auto told = [&](const std::string& text) {
      return std::ranges::count_if(events, [&](const Event& event) {
        return (event.kind + " " + event.detail).find(text) != std::string::npos;
      });
    };
    CHECK(told("kerb wheel=front_") >= 2);
    CHECK(told("closing_speed_mps=") >= 2);
    const int times = speed_mps > 10.0 ? 1 : 0;
    CHECK(told("wheel_damage wheel=front_left height_m=0.1") == times);
    CHECK(told("wheel_damage wheel=front_right height_m=0.1") == times);
    for (const int wheel : {0, 1}) CHECK(state.car.wheels[wheel].damage.any() == (times == 1));
    CHECK(state.diagnostics.bad_numbers == 0);
  }
}

}  // namespace septet::simulation
