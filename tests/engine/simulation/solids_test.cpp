#include "engine/simulation/solids.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <doctest/doctest.h>

#include "engine/simulation/operator_command.hpp"
#include "engine/simulation/storyboard_stage.hpp"
#include "engine/world/participant_shape.hpp"
#include "tests/engine/simulation/stood_solid.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {
namespace {

const StandSolid wall_ahead{.solid = 3, .x_m = 20.0, .length_m = 0.5, .width_m = 6.0, .height_m = 2.0};

StandSolid moving_ball() {
  StandSolid ball{.solid = 2, .x_m = 1.0 / 3.0, .length_m = 0.2, .width_m = 0.2, .height_m = 0.2, .name = "a ball"};
  ball.mass_kg = 0.43, ball.about_x_m = 2.0 / 3.0, ball.about_y_m = -1e5 / 7.0;
  ball.legs = {{1.0 / 7.0, {0.1, -0.2, 0.3}, {0.7, -0.9, 1.0 / 9.0}, {0.0, 0.0, -0.11}}, {.from_s = 9.0}};
  return ball;
}

std::string legs(int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += " leg=0,1,0,0,0,0,0,0";
  return text;
}

double x_of_car_m(const CrashSite& site) { return site.car.participant.world_from_vehicle.position_m.x; }

}  // namespace

TEST_CASE("a solid's commands come back from their texts to the last bit") {
  for (const OperatorCommand& command :
       {OperatorCommand(StandSolid{63, 1.0 / 3.0, -1e5 / 7.0, 0.1, -0.7, 0.05, 200.0, 2.0 / 3.0, {}}),
        OperatorCommand(moving_ball()),
        OperatorCommand(StandSolid{.solid = 1, .name = "stimuli/a wall, name='x' solid=5 å"}),
        OperatorCommand(ClearSolid{63})}) {
    const auto read = parse_operator_command(text_of(command));
    REQUIRE_MESSAGE(read.has_value(), why_not(read));
    CHECK(*read == command);
  }
}

TEST_CASE("a solid out of its bounds is refused as a text and as a value") {
  const std::string good = text_of(wall_ahead);
  REQUIRE(parse_operator_command(good).has_value());
  const auto with = [&](const std::string& before, const std::string& after) {
    std::string text = good;
    return text.replace(text.find(before), before.size(), after);
  };
  for (const std::string& text : {std::string("stand "),
                                  std::string("stand solid=3"),
                                  std::string("clear solid=64"),
                                  std::string("clear "),
                                  good + " ",
                                  good + " mass_kg=0",
                                  good + " mass_kg=nan",
                                  good + " mass_kg=inf",
                                  good + " mass_kg=1e9",
                                  good + " mass_kg=1 mass_kg=1",
                                  good + " about_x_m=1",
                                  good + " about_x_m=nan about_y_m=0 leg=0,1,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,1,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,1,0,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,nan,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=inf,1,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,1001,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,1,0,0,1e5,0,0,0",
                                  good + " about_x_m=0 about_y_m=0 leg=0,1,0,0,0,0,0,1e5",
                                  good + " about_x_m=0 about_y_m=0 leg=2,1,0,0,0,0,0,0 leg=1,1,0,0,0,0,0,0",
                                  good + " about_x_m=0 about_y_m=0" + legs(17),
                                  good + " name=wall",
                                  good + " name=\"wall",
                                  good + " name=\"a\"b\"",
                                  good + " name=\"a\nb\"",
                                  good + " name=\"" + std::string(1025, 'a') + "\"",
                                  good + "  name=\"wall\"",
                                  with("solid=3", "solid=64"),
                                  with("solid=3", "solid=-1"),
                                  with("x_m=20", "x_m=1e300"),
                                  with("x_m=20", "x_m=nan"),
                                  with("x_m=20", "x_m=inf"),
                                  with("x_m=20", "y_m=20"),
                                  with("heading_rad=0", "heading_rad=7"),
                                  with("length_m=0.5", "length_m=0.01"),
                                  with("width_m=6", "width_m=1e4"),
                                  with("height_m=2", "height_m=-2")})
    CHECK_MESSAGE(!parse_operator_command(text).has_value(), text);

  CrashSite site = alone(0.0);
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    StandSolid solid = wall_ahead;
    solid.x_m = value;
    CHECK_FALSE(stand_solid(site.model, solid, site.state).has_value());
    solid = wall_ahead;
    solid.height_m = value;
    CHECK_FALSE(stand_solid(site.model, solid, site.state).has_value());
    solid = wall_ahead;
    solid.mass_kg = -value;
    CHECK_FALSE(stand_solid(site.model, solid, site.state).has_value());
    solid = wall_ahead;
    solid.legs = {{.from_s = -1.0, .velocity_mps = {0.0, value, 0.0}}};
    CHECK_FALSE(stand_solid(site.model, solid, site.state).has_value());
  }
  // Begun long ago, it is far away by now, or fast.
  StandSolid gone = wall_ahead;
  gone.legs = {{.from_s = -1e6, .velocity_mps = {0.0, 1.0, 0.0}}};
  CHECK_FALSE(stand_solid(site.model, gone, site.state).has_value());
  gone.legs = {{.from_s = -20.0, .acceleration_mps2 = {0.0, 100.0, 0.0}}};
  CHECK_FALSE(stand_solid(site.model, gone, site.state).has_value());
  CHECK(site.state.bodies.empty());
  CHECK(site.state.solid_motions.empty());
  CHECK_FALSE(clear_solid({3}, site.state).has_value());
}

TEST_CASE("a car that drives into a solid stops at it, and goes through where it was cleared") {
  CrashSite stopped = alone(12.0);
  stand_in(wall_ahead, stopped);
  pass(stopped, 3.0);
  CHECK(x_of_car_m(stopped) < 20.0);
  CHECK(stopped.state.car.velocity_mps.x < 0.5);
  CHECK(stopped.count("collision") == 1);
  CHECK(find_loose(stopped.state, first_solid_participant + 3)->body.mass_centre_m == Vec2(20.0, 0.0));

  CrashSite passed = alone(12.0);
  stand_in(wall_ahead, passed);
  pass(passed, 0.5);
  REQUIRE(clear_solid({3}, passed.state).has_value());
  passed.participants.resize(1);
  pass(passed, 2.5);
  CHECK(x_of_car_m(passed) > 25.0);
  CHECK(passed.count("collision") == 0);
  CHECK(passed.state.bodies.empty());
}

TEST_CASE("a solid that is stood again is met where it is now") {
  CrashSite site = alone(12.0);
  stand_in(wall_ahead, site);
  StandSolid elsewhere = wall_ahead;
  elsewhere.y_m = 30.0;
  stand_in(elsewhere, site);
  CHECK(site.state.bodies.bodies.size() == 1);
  pass(site, 3.0);
  CHECK(x_of_car_m(site) > 25.0);
  CHECK(site.count("collision") == 0);
}

TEST_CASE("a solid does not stand where the driver's car is") {
  CrashSite site = alone(0.0);
  StandSolid solid = wall_ahead;
  solid.x_m = 1.0;
  const auto done = stand_solid(site.model, solid, site.state);
  REQUIRE_FALSE(done.has_value());
  CHECK(done.error().what == "the driver's car is there");
  solid.z_m = 5.0;  // Above it.
  CHECK(stand_solid(site.model, solid, site.state).has_value());
}

TEST_CASE("solids that stand in each other rest, and nothing is told of them") {
  CrashSite site = alone(0.0);
  stand_in(wall_ahead, site);
  StandSolid second = wall_ahead;
  second.solid = 4, second.x_m = 20.2, second.heading_rad = 0.3;
  stand_in(second, site);
  pass(site, 0.5);
  CHECK(site.rests());
  CHECK(site.events.empty());
  CHECK(site.state.diagnostics.bad_numbers == 0);
}

TEST_CASE("traffic sees a solid as a box that stands, and another swarm leaves it standing") {
  CrashSite site = alone(0.0);
  stand_in(wall_ahead, site);
  site.state.traffic = traffic::own_traffic(site.model.roads, 1);
  const auto foreign = foreign_vehicles(site.model, site.state, site.car.participant);
  REQUIRE(foreign.size() == 2);
  CHECK(foreign[1].id == first_solid_participant + 3);
  CHECK(foreign[1].adrift);
  CHECK(foreign[1].shape().width_m == doctest::Approx(6.0));
  drop_traffic_bodies(site.state);
  CHECK(stands(site.state, 3));
}

}  // namespace septet::simulation
