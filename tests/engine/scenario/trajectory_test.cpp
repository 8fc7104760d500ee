/// Trajectories and routes: their shapes against closed forms, their times, and where they lead.

#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "engine/road/road_position.hpp"
#include "engine/scenario/run/path.hpp"
#include "engine/scenario/run/save_scenario.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {
namespace {

constexpr double pi = std::numbers::pi;

Position at(double x, double y) {
  WorldPosition position;
  position.position_m = {x, y, 0.0};
  return position;
}
Position facing(double x, double y, double heading_rad) {
  auto position = std::get<WorldPosition>(at(x, y));
  position.heading_given = true;
  position.heading_rad = heading_rad;
  return position;
}

Path lay(const Trajectory& trajectory) {
  EntityState actor;
  actor.active = true;
  const auto path = lay_path(test_road(), ScenarioState{}, actor, trajectory);
  REQUIRE(path.has_value());
  return *path;
}
Path lay_shape(decltype(Trajectory::shape) shape, bool closed = false) { return lay({"t", closed, std::move(shape)}); }

std::string vertex_text(double time, double x, double y) {
  return "<Vertex time=\"" + std::to_string(time) + "\"><Position><WorldPosition x=\"" + std::to_string(x) + "\" y=\"" +
         std::to_string(y) + "\"/></Position></Vertex>";
}
std::string follow_text(const std::string& vertices, const std::string& reference, const std::string& attributes = "",
                        const std::string& mode = "position") {
  return "<PrivateAction><RoutingAction><FollowTrajectoryAction " + attributes +
         "><TrajectoryRef><Trajectory name=\"t\" closed=\"false\"><Shape><Polyline>" + vertices +
         "</Polyline></Shape></Trajectory></TrajectoryRef><TimeReference>" + reference +
         "</TimeReference><TrajectoryFollowingMode followingMode=\"" + mode +
         "\"/></FollowTrajectoryAction></RoutingAction></PrivateAction>";
}
const std::string relative_times = R"(<Timing domainAbsoluteRelative="relative" scale="1" offset="0"/>)";

/// A road that forks after 100 m: straight on ("S", then "D") or in a quarter turn to the left of radius 50 m ("T",
/// then "E").
road::RoadNetwork fork() {
  const auto road = [](road::SmallRoad of, const std::string& lane_link) {
    of.sections = road::lane_section("", road::lane(-1, 3.5, "<link>" + lane_link + "</link>"));
    return of.text();
  };
  const std::string both = R"(<predecessor id="-1"/><successor id="-1"/>)";
  const std::string from_a = road::link_to_road("predecessor", "A", "end");
  const std::string from_junction = road::link_to_junction("predecessor", "J");
  constexpr double quarter_rad = 0.5 * std::numbers::pi;
  const std::string text = road::roads_text(
      road({.length_m = 100.0, .id = "A", .link = road::link_to_junction("successor", "J")}, "") +
      road({.length_m = 50.0,
            .id = "S",
            .junction = "J",
            .link = from_a + road::link_to_road("successor", "D", "start"),
            .x_m = 100.0},
           both) +
      road({.length_m = 50.0 * quarter_rad,
            .geometry = road::arc(0.02),
            .id = "T",
            .junction = "J",
            .link = from_a + road::link_to_road("successor", "E", "start"),
            .x_m = 100.0},
           both) +
      road({.length_m = 500.0, .id = "D", .link = from_junction, .x_m = 150.0}, "") +
      road({.length_m = 500.0, .id = "E", .link = from_junction, .x_m = 150.0, .y_m = 50.0, .heading_rad = quarter_rad},
           "") +
      "<junction id=\"J\" name=\"J\">" + road::connection("0", "A", "S") + road::connection("1", "A", "T") +
      "</junction>");
  auto network = road::read_opendrive(text, "fork.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  return std::move(*network);
}
std::string lane_text(const std::string& road, double s) {
  return "<Position><LanePosition roadId=\"" + road + "\" laneId=\"-1\" s=\"" + std::to_string(s) + "\"/></Position>";
}
std::string teleport_text(const std::string& position) {
  return "<PrivateAction><TeleportAction>" + position + "</TeleportAction></PrivateAction>";
}
std::string routing_text(const std::string& action) {
  return "<PrivateAction><RoutingAction>" + action + "</RoutingAction></PrivateAction>";
}
const std::string to_e = "<Route name=\"r\" closed=\"false\"><Waypoint routeStrategy=\"shortest\">" +
                         lane_text("A", 10) + "</Waypoint><Waypoint routeStrategy=\"shortest\">" + lane_text("E", 100) +
                         "</Waypoint></Route>";

/// The road on which A is after so many seconds.
std::string road_after(const std::string& init, double seconds) {
  const Scenario scenario = read_or_stop(scenario_text(init, ""));
  const road::RoadNetwork network = fork();
  StepResult result;
  auto state = start_scenario(scenario, network, no_entity, result);
  REQUIRE_MESSAGE(state.has_value(), why_not(state));
  while (state->time_s < seconds) advance_scenario(scenario, network, 0.01, *state);
  REQUIRE(state->entities[0].on_road);
  return network.roads[state->entities[0].lane.road].id;
}

}  // namespace

TEST_CASE("an arc of a clothoid is an arc and its length that of the file") {
  const ClothoidSplineShape shape{{{facing(10, 20, 0.0), 0.02, 0.02, 25.0 * pi, 0.0, 0.0}}, 5.0};
  const Path path = lay_shape(shape);
  CHECK(path.length_m() == doctest::Approx(25.0 * pi));
  const PathPoint end = path.points.back();
  CHECK(end.position_m.x == relative(60.0, 1e-9));
  CHECK(end.position_m.y == relative(70.0, 1e-9));
  CHECK(end.heading_rad == doctest::Approx(pi / 2.0));
  CHECK(end.time_s == 5.0);
  CHECK(path_at_time(path, 2.5).s_m == doctest::Approx(12.5 * pi));
}

TEST_CASE("a clothoid is the Fresnel integral") {
  const double length = 80.0, growth = 0.001;
  const Path path = lay_shape(ClothoidSplineShape{{{facing(0, 0, 0.0), 0.0, growth * length, length, 0.0, 0.0}}, 0.0});
  // The series of ∫ cos(a s²/2) and ∫ sin(a s²/2), with u = a L²/2.
  const double u = 0.5 * growth * length * length;
  double x = 0.0, y = 0.0, term = 1.0;
  for (int n = 0; n < 40; ++n) {
    (n % 2 == 0 ? x : y) += (n % 4 < 2 ? 1.0 : -1.0) * term / (2 * n + 1);
    term *= u / (n + 1);
  }
  CHECK(path.points.back().position_m.x == relative(length * x, 1e-6));
  CHECK(path.points.back().position_m.y == relative(length * y, 1e-6));
  CHECK(path.points.back().heading_rad == doctest::Approx(u));
  CHECK(path_at_station(path, 40.0).heading_rad == relative(u / 4.0, 1e-5));
}

TEST_CASE("segments of a clothoid spline go on where the one before ends and turn by their offset") {
  ClothoidSplineShape shape;
  shape.segments.push_back({facing(0, 0, 0.0), 0.0, 0.0, 10.0, 0.0, 0.0});
  shape.segments.push_back({std::nullopt, 0.0, 0.0, 5.0, pi / 2.0, 2.0});
  shape.segments.push_back({at(0, 30), 0.0, 0.0, 5.0, 0.0, 4.0});
  shape.end_time_s = 5.0;
  const Path path = lay_shape(shape);
  CHECK(path.length_m() == doctest::Approx(20.0));
  CHECK(path_at_station(path, 14.999).position_m.y == doctest::Approx(4.999));
  CHECK(path_at_station(path, 12.0).position_m.x == doctest::Approx(10.0));
  CHECK(path_at_station(path, 17.0).position_m.y == doctest::Approx(30.0));
  CHECK(path_at_time(path, 3.0).s_m == doctest::Approx(12.5));
  CHECK(path_at_time(path, 4.5).s_m == doctest::Approx(17.5));
}

TEST_CASE("a spline of very many long segments has few points") {
  ClothoidSplineShape shape;
  for (int i = 0; i < 1000; ++i) shape.segments.push_back({std::nullopt, 0.0, 1e-5, 1e5, 0.0, 0.0});
  CHECK(lay_shape(shape).points.size() < 25'000);
}

TEST_CASE("nine weighted points are a circle") {
  const double corner = std::sqrt(0.5), radius = 30.0;
  NurbsShape shape;
  shape.order = 3;
  const double xs[] = {1, 1, 0, -1, -1, -1, 0, 1, 1}, ys[] = {0, 1, 1, 1, 0, -1, -1, -1, 0};
  for (int i = 0; i < 9; ++i)
    shape.points.push_back({at(radius * xs[i], radius * ys[i]), i % 2 == 0 ? 1.0 : corner, 1.0 * i});
  shape.knots = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
  const Path path = lay_shape(shape);
  CHECK(path.length_m() == relative(2.0 * pi * radius, 1e-5));
  CHECK(path.end_s() == 8.0);
  for (double s = 0.0; s < path.length_m(); s += 3.0) {
    const PathPoint point = path_at_station(path, s);
    CHECK(glm::length(point.position_m) == relative(radius, 1e-4));
    CHECK(point.heading_rad == relative(pi / 2.0 + s / radius, 0.005));
  }
}

TEST_CASE("a line between points is driven evenly and turns near its corners") {
  const Path path = lay_shape(PolylineShape{{{at(0, 0), 0.0}, {at(20, 0), 2.0}, {at(20, 20), 6.0}}});
  CHECK(path.length_m() == doctest::Approx(40.0));
  CHECK(path_at_time(path, 4.0).s_m == doctest::Approx(30.0));
  CHECK(path_at_station(path, 17.0).heading_rad == doctest::Approx(0.0));
  CHECK(path_at_station(path, 20.0).heading_rad == doctest::Approx(pi / 4.0));
  CHECK(path_at_station(path, 23.0).heading_rad == doctest::Approx(pi / 2.0));
}

TEST_CASE("headings of the file are turned through evenly, the short way") {
  const Path path = lay_shape(PolylineShape{{{facing(0, 0, 3.0), 0.0}, {facing(10, 0, -3.0), 1.0}}});
  CHECK(path.points.front().heading_rad == doctest::Approx(3.0));
  CHECK(path.points.back().heading_rad == doctest::Approx(2.0 * pi - 3.0));
  CHECK(path_at_station(path, 5.0).heading_rad == doctest::Approx(pi));
}

TEST_CASE("a closed line comes back to its first point as fast as it went") {
  const PolylineShape square{{{at(0, 0), 1.0}, {at(10, 0), 2.0}, {at(10, 10), 3.0}, {at(0, 10), 4.0}}};
  CHECK(lay_shape(square).length_m() == doctest::Approx(30.0));
  const Path ring = lay_shape(square, true);
  CHECK(ring.length_m() == doctest::Approx(40.0));
  CHECK(ring.end_s() == doctest::Approx(5.0));
  CHECK(glm::length(ring.points.back().position_m) == doctest::Approx(0.0));
  PolylineShape repeated = square;
  repeated.vertices.push_back({at(0, 0), 7.0});
  CHECK(lay_shape(repeated, true).length_m() == doctest::Approx(40.0));
  CHECK(lay_shape(repeated, true).end_s() == 7.0);
}

TEST_CASE("two points at one place are a wait") {
  const Path path = lay_shape(PolylineShape{{{at(0, 0), 0.0}, {at(10, 0), 1.0}, {at(10, 0), 4.0}, {at(30, 0), 5.0}}});
  for (const double time : {1.0, 2.5, 4.0}) CHECK(path_at_time(path, time).s_m == doctest::Approx(10.0));
  CHECK(path_at_time(path, 4.5).s_m == doctest::Approx(20.0));
  for (const PathPoint& point : path.points) CHECK(point.heading_rad == doctest::Approx(0.0));
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e",
                                                    follow_text(vertex_text(0, 100, -5) + vertex_text(1, 110, -5) +
                                                                    vertex_text(4, 110, -5) + vertex_text(5, 130, -5),
                                                                relative_times),
                                                    at_time(0.0)))));
  drive.run_until(2.0);
  CHECK(drive.a().speed_mps == 0.0);
  CHECK(drive.a().world_from_entity.position_m.x == doctest::Approx(110.0));
  drive.run_until(6.0);
  CHECK(drive.a().speed_mps == doctest::Approx(20.0));
  CHECK(drive.time_of("e", ElementTransition::end) == doctest::Approx(4.99));
}

TEST_CASE("times of a trajectory count from the action or from the start of the drive") {
  const std::string way = vertex_text(2, 100, -5) + vertex_text(6, 180, -5);
  const auto drive_with = [&](const std::string& domain, const std::string& attributes = "") {
    return Drive(scenario_text(
        two_cars, story_text(event_text(
                      "e",
                      follow_text(way, "<Timing domainAbsoluteRelative=\"" + domain + "\" scale=\"1\" offset=\"0.5\"/>",
                                  attributes),
                      at_time(1.0)))));
  };
  const auto x_at = [](Drive drive, double time_s) {
    drive.run_until(time_s);
    return drive.a().world_from_entity.position_m.x;
  };
  CHECK(x_at(drive_with("absolute"), 4.5) == doctest::Approx(140.0));
  CHECK(x_at(drive_with("relative"), 5.5) == doctest::Approx(140.0));
  // 40 m of the trajectory are cut off, and the 4.5 s that pass until there.
  CHECK(x_at(drive_with("relative", "initialDistanceOffset=\"40\""), 2.0) == doctest::Approx(160.0));
}

TEST_CASE("without times one begins at the initial distance and keeps one's speed") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e",
                                                    follow_text(vertex_text(0, 100, -5) + vertex_text(0, 100, 75),
                                                                "<None/>", "initialDistanceOffset=\"30\""),
                                                    at_time(0.0)))));
  drive.run_until(1.0);
  CHECK(drive.a().world_from_entity.position_m.y == doctest::Approx(45.0));
  CHECK(drive.a().speed_mps == 20.0);
  CHECK(drive.a().travelled_m == doctest::Approx(20.0));
  drive.run_until(3.0);
  CHECK(drive.time_of("e", ElementTransition::end) == doctest::Approx(2.49));
}

TEST_CASE("a trajectory with nothing between two instants jumps and keeps the speed") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e",
                                                    follow_text(vertex_text(0, 100, -5) + vertex_text(2, 140, -5) +
                                                                    vertex_text(2, 640, -5) + vertex_text(4, 680, -5),
                                                                relative_times),
                                                    at_time(0.0)))));
  while (drive.state.time_s < 4.0) {
    drive.run_until(drive.state.time_s + 0.01);
    CHECK(drive.a().speed_mps <= 30.0);
  }
  CHECK(drive.a().world_from_entity.position_m.x == relative(680.0, 0.001));
}

TEST_CASE("a lane change or another trajectory takes the entity off its trajectory") {
  const std::string way = vertex_text(0, 100, -5.25) + vertex_text(10, 300, -5.25);
  Drive drive(
      scenario_text(two_cars, story_text(event_text("e", follow_text(way, "<None/>"), at_time(0.0)) +
                                         event_text("f", lane_change_text(1, "linear", "time", 2.0), at_time(1.0)))));
  drive.run_until(4.0);
  CHECK(drive.time_of("e action", ElementTransition::stop) == doctest::Approx(1.0));
  CHECK(drive.a().world_from_entity.position_m.y == doctest::Approx(-1.75));
}

TEST_CASE("falling times are refused where they count and followingMode follow is named") {
  const std::string falling = vertex_text(3, 100, -5) + vertex_text(1, 200, -5);
  const auto read = [&](const std::string& action, std::vector<Finding>& findings) {
    findings = check_scenario(scenario_text(two_cars, story_text(event_text("e", action, at_time(0.0)))), "test.xosc",
                              files_in("."));
    std::string all;
    for (const Finding& finding : findings) all += describe(finding.error) + "\n";
    return all;
  };
  std::vector<Finding> findings;
  CHECK(read(follow_text(falling, relative_times), findings).find("do not rise from point to point") !=
        std::string::npos);
  CHECK(read(follow_text(falling, "<None/>"), findings).find("rise from") == std::string::npos);
  CHECK(read(follow_text(vertex_text(0, 100, -5) + vertex_text(1, 200, -5), "<None/>", "", "follow"), findings)
            .find("followingMode=\"follow\" is not supported") != std::string::npos);
}

TEST_CASE("without a route one goes straight on and with one along it") {
  const std::string start = teleport_text(lane_text("A", 20)) + speed_text(20);
  CHECK(road_after(private_text("A", start), 8.5) == "D");
  CHECK(road_after(private_text("A", start + routing_text("<AssignRouteAction>" + to_e + "</AssignRouteAction>")),
                   8.5) == "E");
  CHECK(road_after(private_text("A", start + routing_text("<AcquirePositionAction>" + lane_text("E", 50) +
                                                          "</AcquirePositionAction>")),
                   8.5) == "E");
  // Nothing leads back to A: the path is as without it.
  CHECK(road_after(private_text("A", start + routing_text("<AcquirePositionAction>" + lane_text("A", 5) +
                                                          "</AcquirePositionAction>")),
                   8.5) == "D");
}

TEST_CASE("a scenario that was saved beyond the first road of its route goes on from there") {
  const Scenario scenario = read_or_stop(
      scenario_text(private_text("A", teleport_text(lane_text("A", 20)) + speed_text(20) +
                                          routing_text("<AssignRouteAction>" + to_e + "</AssignRouteAction>")),
                    ""));
  const road::RoadNetwork network = fork();
  StepResult result;
  auto driven = start_scenario(scenario, network, no_entity, result),
       restored = start_scenario(scenario, network, no_entity, result);
  REQUIRE_MESSAGE(driven.has_value(), why_not(driven));
  REQUIRE_MESSAGE(restored.has_value(), why_not(restored));
  while (driven->entities[0].route.at == 0 && driven->time_s < 10.0) advance_scenario(scenario, network, 0.01, *driven);
  REQUIRE(driven->entities[0].route.at > 0);
  Bytes bytes;
  StateWriter writer(bytes);
  save_scenario(*driven, writer);
  StateReader reader(bytes);
  restore_scenario(scenario, network, reader, *restored);
  REQUIRE(reader.ok());
  for (int step = 0; step < 500; ++step) {
    advance_scenario(scenario, network, 0.01, *driven);
    advance_scenario(scenario, network, 0.01, *restored);
  }
  const EntityState &as_driven = driven->entities[0], &as_restored = restored->entities[0];
  CHECK(network.roads[as_restored.lane.road].id == "E");
  CHECK(as_restored.world_from_entity.position_m == as_driven.world_from_entity.position_m);
}

TEST_CASE("a place on a route is so far from its first waypoint") {
  const auto place = [&](const std::string& in) {
    const std::string position = "<Position><RoutePosition><RouteRef>" + to_e + "</RouteRef><InRoutePosition>" + in +
                                 "</InRoutePosition></RoutePosition></Position>";
    const Scenario scenario = read_or_stop(scenario_text(private_text("A", teleport_text(position)), ""));
    const road::RoadNetwork network = fork();
    StepResult result;
    const auto state = start_scenario(scenario, network, no_entity, result);
    REQUIRE_MESSAGE(state.has_value(), why_not(state));
    return state->entities[0];
  };
  const EntityState in_turn = place("<FromLaneCoordinates pathS=\"110\" laneId=\"-1\"/>");
  CHECK(in_turn.lane.s_m == doctest::Approx(20.0));
  CHECK(heading_rad(in_turn.world_from_entity.orientation) == doctest::Approx(20.0 * 0.02));
  const EntityState at_t = place("<FromRoadCoordinates pathS=\"50\" t=\"-1\"/>");
  CHECK(at_t.world_from_entity.position_m.x == doctest::Approx(60.0));
  CHECK(at_t.world_from_entity.position_m.y == doctest::Approx(-1.0));
}

TEST_CASE("boxes that cross without a corner in the other collide and those on a bridge do not") {
  const std::string box =
      R"(<BoundingBox><Center x="0" y="0" z="0.7"/><Dimensions width="1.8" length="4.6" height="1.4"/></BoundingBox>)";
  const auto collide = [&](double height) {
    const std::string across =
        "<PrivateAction><TeleportAction><Position><RelativeObjectPosition entityRef=\"A\" dx=\"0\" "
        "dy=\"0\"><Orientation type=\"relative\" "
        "h=\"1.5707963\"/></RelativeObjectPosition></Position></TeleportAction></PrivateAction>";
    std::string text = scenario_text(
        private_text("A", place_text(-2, 100)) + private_text("B", across),
        story_text(event_text("e", speed_text(0),
                              trigger_text(of_entity_text(
                                  "A", "<CollisionCondition><EntityRef entityRef=\"B\"/></CollisionCondition>")))));
    for (auto found = text.find("<BoundingBox>"); found != text.npos; found = text.find("<BoundingBox>", found + 1))
      text.replace(found, text.find("</BoundingBox>", found) + 14 - found, box);
    Drive drive(text);
    drive.state.entities[1].external = true;
    drive.state.entities[1].world_from_entity.position_m.z += height;
    drive.run_until(0.02);
    return drive.count_of("e", ElementTransition::start) == 1;
  };
  CHECK(collide(0.0));
  CHECK(collide(1.3));
  CHECK_FALSE(collide(6.0));
}

}  // namespace septet::scenario
