/// Motion of an entity by a story: its profile of speed, its curve to another lane, its trajectory.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <doctest/doctest.h>

#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"

namespace septet::scenario {

TEST_CASE(
    "what is told of a scripted vehicle is the derivative of its place: in bends, on hills, changing lanes and askew") {
  const std::string hill = R"(<elevationProfile><elevation s="0" a="0" b="0.08" c="0" d="0"/></elevationProfile>)";
  const std::string askew =
      "<PrivateAction><TeleportAction><Position><LanePosition roadId=\"R\" laneId=\"-2\" s=\"100\"><Orientation "
      "h=\"0.4\" type=\"relative\"/></LanePosition></Position></TeleportAction></PrivateAction>";
  const struct {
    std::string shape, profiles, place;
  } roads[] = {{R"(<arc curvature="0.02"/>)", "", place_text(-2, 100)},
               {R"(<arc curvature="-0.02"/>)", "", place_text(-2, 100)},
               {"<line/>", hill, place_text(-2, 100)},
               {R"(<spiral curvStart="0" curvEnd="0.02"/>)", hill, place_text(-2, 100)},
               {R"(<arc curvature="0.01"/>)", "", askew}};
  for (const auto& [shape, profiles, place] : roads) {
    const std::string where = shape + profiles + place;
    CAPTURE(where);
    const std::string init = private_text("A", place + speed_text(12)) + private_text("B", place_text(-3, 900));
    Drive drive(
        scenario_text(init,
                      story_text(event_text("change", lane_change_text(1, "sinusoidal", "time", 4.0), at_time(1.0)) +
                                 event_text("faster", speed_text(16, "linear", "time", 4.0), at_time(3.0)))),
        test_road(road_text(shape, profiles)));
    drive.run_until(0.5);
    std::size_t off = 0, seen = 0;
    EntityState before = drive.a();
    drive.run_until(0.51);
    EntityState now = drive.a();
    for (double time_s = 0.52; time_s < 8.0; time_s += 0.01) {
      drive.run_until(time_s);
      const Vec3 moved = (drive.a().world_from_entity.position_m - before.world_from_entity.position_m) / 0.02;
      off += glm::length(moved - now.velocity_mps) > 1.5e-3 * now.speed_mps;
      ++seen;
      before = now;
      now = drive.a();
    }
    CHECK(seen > 700);
    CHECK(off <= 4);
  }
}

TEST_CASE("every shape takes its time and ends at its speed") {
  for (const std::string shape : {"linear", "sinusoidal", "cubic"}) {
    CAPTURE(shape);
    Drive drive(scenario_text(two_cars, story_text(event_text("e", speed_text(30, shape, "time", 4.0), at_time(1.0)))));
    drive.run_until(3.0);
    CHECK(drive.a().speed_mps == relative(25.0, 0.001));
    drive.run_until(6.0);
    CHECK(drive.a().speed_mps == 30.0);
    // 1 s at 20, 4 s at a mean of 25, 1 s at 30 m/s.
    CHECK(drive.a().world_from_entity.position_m.x == relative(250.0, 1e-4));
    CHECK(drive.time_of("e", ElementTransition::end) == doctest::Approx(4.99));
  }
}

TEST_CASE("a rate is the greatest rate and a distance is kept") {
  Drive rate(
      scenario_text(two_cars, story_text(event_text("e", speed_text(30, "sinusoidal", "rate", 2.0), at_time(0.0)))));
  double greatest = 0.0;
  while (rate.state.time_s < 10.0) {
    rate.run_until(rate.state.time_s + 0.01);
    greatest = std::max(greatest, rate.a().acceleration_mps2);
  }
  CHECK(greatest == relative(2.0, 0.001));
  Drive distance(
      scenario_text(two_cars, story_text(event_text("e", speed_text(30, "linear", "distance", 125.0), at_time(0.0)))));
  distance.run_until(4.0);
  CHECK(distance.a().speed_mps == doctest::Approx(28.0));
  distance.run_until(5.0);
  CHECK(distance.a().speed_mps == 30.0);
  CHECK(distance.a().world_from_entity.position_m.x == relative(225.0, 1e-3));
}

TEST_CASE("acceleration never exceeds what the vehicle can do") {
  Drive drive(scenario_text(two_cars, story_text(event_text("e", speed_text(50, "cubic", "time", 0.5), at_time(0.0)))));
  double greatest = 0.0;
  while (drive.state.time_s < 8.0) {
    drive.run_until(drive.state.time_s + 0.01);
    greatest = std::max(greatest, drive.a().acceleration_mps2);
  }
  CHECK(greatest == relative(10.0, 0.001));
  CHECK(drive.a().speed_mps == 50.0);
}

TEST_CASE("a lane change is one smooth curve to the centre of the next lane") {
  for (const std::string dimension : {"time", "distance", "rate"}) {
    CAPTURE(dimension);
    const double value = dimension == "time" ? 4.0 : dimension == "distance" ? 80.0 : 3.5 * std::numbers::pi / 8.0;
    Drive drive(scenario_text(
        two_cars, story_text(event_text("e", lane_change_text(1, "sinusoidal", dimension, value), at_time(0.0)))));
    CHECK(drive.a().world_from_entity.position_m.y == doctest::Approx(-5.25));
    drive.run_until(2.0);
    CHECK(drive.a().world_from_entity.position_m.y == relative(-3.5, 0.01));
    const double slope = 3.5 * std::numbers::pi / 8.0 / 20.0;
    CHECK(heading_rad(drive.a().world_from_entity.orientation) == relative(slope, 0.01));
    drive.run_until(4.2);
    CHECK(drive.a().world_from_entity.position_m.y == doctest::Approx(-1.75));
    CHECK(heading_rad(drive.a().world_from_entity.orientation) == doctest::Approx(0.0));
    CHECK(drive.a().lane.lane == -1);
  }
}

TEST_CASE("a rate of 0 keeps the speed and ends at once where that is the target") {
  Drive drive(
      scenario_text(two_cars, story_text(event_text("same", speed_text(20, "linear", "rate", 0.0), at_time(0.0)) +
                                         event_text("other", speed_text(30, "linear", "rate", 0.0), at_time(1.0)))));
  drive.run_until(3.0);
  CHECK(drive.time_of("same", ElementTransition::end) == doctest::Approx(0.0));
  CHECK(drive.count_of("other", ElementTransition::start) == 1);
  CHECK(drive.count_of("other", ElementTransition::end) == 0);
  CHECK(drive.a().speed_mps == 20.0);
  CHECK(drive.a().world_from_entity.position_m.x == doctest::Approx(160.0));
}

TEST_CASE("a trajectory is followed at one's own speed or by its times and then the lane") {
  const auto follow = [](const std::string& reference) {
    const auto vertex = [](double time, double x, double y) {
      return "<Vertex time=\"" + std::to_string(time) + "\"><Position><WorldPosition x=\"" + std::to_string(x) +
             "\" y=\"" + std::to_string(y) + "\"/></Position></Vertex>";
    };
    return "<PrivateAction><RoutingAction><FollowTrajectoryAction><TrajectoryRef><Trajectory name=\"t\" "
           "closed=\"false\"><Shape><Polyline>" +
           vertex(0, 140, -5.25) + vertex(4, 170, 34.75) + vertex(6, 230, 34.75) + vertex(12, 230, -1.75) +
           "</Polyline></Shape></Trajectory></TrajectoryRef><TimeReference>" + reference +
           "</TimeReference><TrajectoryFollowingMode "
           "followingMode=\"position\"/></FollowTrajectoryAction></RoutingAction></PrivateAction>";
  };
  Drive own(scenario_text(two_cars, story_text(event_text("e", follow("<None/>"), at_time(2.0)))));
  own.run_until(4.0);
  // 40 m along a line of 3 : 4.
  CHECK(own.a().world_from_entity.position_m.x == doctest::Approx(164.0));
  CHECK(own.a().world_from_entity.position_m.y == doctest::Approx(26.75));
  CHECK(heading_rad(own.a().world_from_entity.orientation) == doctest::Approx(std::atan2(4.0, 3.0)));
  CHECK(own.a().speed_mps == 20.0);
  CHECK_FALSE(own.a().on_road);
  own.run_until(4.5);  // At the first corner, half turned.
  CHECK(heading_rad(own.a().world_from_entity.orientation) == doctest::Approx(0.5 * std::atan2(4.0, 3.0)));

  Drive timed(scenario_text(
      two_cars,
      story_text(event_text("e", follow(R"(<Timing domainAbsoluteRelative="relative" scale="0.5" offset="0"/>)"),
                            at_time(2.0)))));
  timed.run_until(4.5);
  CHECK(timed.a().world_from_entity.position_m.x == doctest::Approx(200.0));
  CHECK(timed.a().speed_mps == doctest::Approx(60.0));
  timed.run_until(9.0);
  CHECK(timed.time_of("e", ElementTransition::end) == doctest::Approx(7.99));
  CHECK(timed.a().on_road);
  CHECK(timed.a().lane.lane == -1);
}

}  // namespace septet::scenario
