/// Speed profiles, distances from others and meetings: bounds, times and places.

#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "engine/scenario/run/keep_distance.hpp"
#include "engine/scenario/run/speed_profile.hpp"
#include "engine/scenario/run/synchronize.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"

namespace septet::scenario {
namespace {

std::string longitudinal(const std::string& action) {
  return "<PrivateAction><LongitudinalAction>" + action + "</LongitudinalAction></PrivateAction>";
}
std::string lateral(const std::string& action) {
  return "<PrivateAction><LateralAction>" + action + "</LateralAction></PrivateAction>";
}
std::string profile_text(const std::string& mode, const std::string& content, const std::string& attributes = "") {
  return longitudinal("<SpeedProfileAction followingMode=\"" + mode + "\" " + attributes + ">" + content +
                      "</SpeedProfileAction>");
}
std::string entry(const std::string& time, double speed) {
  return "<SpeedProfileEntry " + (time.empty() ? "" : "time=\"" + time + "\"") + " speed=\"" + std::to_string(speed) +
         "\"/>";
}
std::string gap_text(const std::string& attributes, const std::string& limits, bool continuous) {
  return longitudinal("<LongitudinalDistanceAction entityRef=\"B\" continuous=\"" +
                      std::string(continuous ? "true" : "false") + "\" " + attributes + ">" + limits +
                      "</LongitudinalDistanceAction>");
}
std::string beside_text(const std::string& attributes, const std::string& limits, bool continuous) {
  return lateral("<LateralDistanceAction entityRef=\"B\" continuous=\"" + std::string(continuous ? "true" : "false") +
                 "\" " + attributes + ">" + limits + "</LateralDistanceAction>");
}

/// A at 100 m with 20 m/s, B so far ahead in a lane of its own or the same.
std::string cars(double ahead_m, double b_mps, int b_lane = -2) {
  return private_text("A", place_text(-2, 100) + speed_text(20)) +
         private_text("B", place_text(b_lane, 100 + ahead_m) + speed_text(b_mps));
}
Drive drive_with(const std::string& init, const std::string& action, double time_s = 0.0) {
  return Drive(scenario_text(init, story_text(event_text("e", action, at_time(time_s)))));
}
double gap_m(const Drive& drive) {
  return drive.b().world_from_entity.position_m.x - drive.a().world_from_entity.position_m.x;
}
double left_m(const Drive& drive) {
  return drive.a().world_from_entity.position_m.y - drive.b().world_from_entity.position_m.y;
}
constexpr double touching_m = 4.6;  ///< Between the reference points of two cars, bumper to bumper.
const std::string gentle = R"(<DynamicConstraints maxAcceleration="2" maxDeceleration="3" maxSpeed="40"/>)";

}  // namespace

TEST_CASE("a profile goes straight from speed to speed in its times") {
  Drive drive =
      drive_with(cars(200, 10), profile_text("position", entry("0", 20) + entry("4", 30) + entry("2", 24)), 1.0);
  drive.run_until(1.01);
  CHECK(drive.a().speed_mps == doctest::Approx(20.025));
  drive.run_until(3.0);
  CHECK(drive.a().speed_mps == doctest::Approx(25.0));
  drive.run_until(6.0);
  CHECK(drive.a().speed_mps == doctest::Approx(27.0));
  drive.run_until(9.0);
  CHECK(drive.a().speed_mps == doctest::Approx(24.0));
  CHECK(drive.time_of("e", ElementTransition::end) == doctest::Approx(6.99));
}

TEST_CASE("a followed profile has its speeds at its times with bounded acceleration and jerk") {
  SpeedProfileAction action;
  action.entries = {{4.0, 10.0}, {4.0, 4.0}, {2.0, 8.0}};
  action.smooth = true;
  const DynamicConstraints limits{50.0, 5.0, 10.0, 4.0, 3.0};
  // At their bounds, the last change takes √(2 · 4 · (1/4 + 1/3)) = 2.16 s, more than it is given.
  const SpeedProfile profile = lay_speed_profile(action, 0.0, limits);
  CHECK(speed_at(profile, 0.0) == 0.0);
  CHECK(speed_at(profile, 4.0) == doctest::Approx(10.0));
  CHECK(speed_at(profile, 8.0) == doctest::Approx(4.0));
  CHECK(profile.end_s == doctest::Approx(8.0 + std::sqrt(8.0 * 7.0 / 12.0)));
  CHECK(speed_at(profile, 100.0) == 8.0);
  const double dt = 1e-3;
  double before = 0.0;
  for (double t = dt; t < profile.end_s; t += dt) {
    const double a = (speed_at(profile, t) - speed_at(profile, t - dt)) / dt;
    const double jerk = (a - before) / dt;
    CHECK(a <= 5.0);
    CHECK(a >= -10.0);
    CHECK(std::abs(jerk) <= 4.01);
    if (t < 2 * dt || t > profile.end_s - dt) CHECK(std::abs(a) < 0.01);
    before = a;
  }
}

TEST_CASE("a speed without a time is there as soon as the bounds allow") {
  SpeedProfileAction action;
  action.entries = {{std::nullopt, 30.0}};
  const double none = std::numeric_limits<double>::infinity();
  CHECK(lay_speed_profile(action, 20.0, {none, 2.0, none, none, none}).end_s == doctest::Approx(5.0));
  CHECK(lay_speed_profile(action, 20.0, {none, none, none, none, none}).end_s == 0.0);
  CHECK(lay_speed_profile(action, 20.0, {25.0, 2.0, none, none, none}).end_mps == 25.0);
  action.smooth = true;
  // 10 m/s at 2 m/s², and 2 s to get there and back at 1 m/s³.
  CHECK(lay_speed_profile(action, 20.0, {none, 2.0, none, 1.0, 1.0}).end_s == doctest::Approx(7.0));
  Drive drive = drive_with(cars(200, 10), profile_text("position", entry("0.5", 50)));
  drive.run_until(2.0);
  CHECK(drive.a().acceleration_mps2 == doctest::Approx(10.0));  // The vehicle's limit.
  drive.run_until(3.0);
  CHECK(drive.a().speed_mps == doctest::Approx(50.0));
}

TEST_CASE("a profile against another entity adds its speed") {
  Drive drive(scenario_text(
      cars(200, 10),
      story_text(
          event_text("e", profile_text("position", entry("2", 5) + entry("2", 0), "entityRef=\"B\""), at_time(0.0)))));
  drive.run_until(2.0);
  CHECK(drive.a().speed_mps == doctest::Approx(15.0));
  drive.run_until(5.0);
  CHECK(drive.a().speed_mps == doctest::Approx(10.0));
}

TEST_CASE("a distance without bounds is there at once and rigid") {
  Drive drive = drive_with(cars(80, 10), gap_text("distance=\"20\" freespace=\"true\"", "", true), 1.0);
  drive.run_until(1.01);
  CHECK(gap_m(drive) == doctest::Approx(20.0 + touching_m));
  CHECK(drive.a().speed_mps == doctest::Approx(10.0));
  drive.state.entities[1].speed_mps = 17.0;
  drive.run_until(3.0);
  CHECK(gap_m(drive) == doctest::Approx(20.0 + touching_m));
  CHECK(drive.a().speed_mps == doctest::Approx(17.0));
  CHECK(drive.count_of("e", ElementTransition::end) == 0);
  Drive once = drive_with(cars(80, 10), gap_text("distance=\"20\" freespace=\"false\"", "", false), 1.0);
  once.run_until(2.0);
  CHECK(gap_m(once) == doctest::Approx(20.0));
  CHECK(once.time_of("e", ElementTransition::end) == doctest::Approx(1.0));
}

TEST_CASE("a distance is approached within the bounds and never fallen below") {
  for (const bool continuous : {true, false}) {
    for (const std::string system : {"entity", "road", "lane"}) {
      CAPTURE(system);
      Drive drive = drive_with(
          cars(150, 10),
          gap_text("distance=\"20\" freespace=\"true\" coordinateSystem=\"" + system + "\"", gentle, continuous));
      double least = 1e9;
      while (drive.state.time_s < 25.0) {
        drive.run_until(drive.state.time_s + 0.01);
        least = std::min(least, gap_m(drive));
        CHECK(drive.a().acceleration_mps2 <= 2.0 + 1e-6);
        CHECK(drive.a().acceleration_mps2 >= -3.0 - 1e-6);
        if (continuous) continue;
        if (drive.count_of("e", ElementTransition::end) > 0) break;
      }
      CHECK(least > 20.0 + touching_m - 0.05);
      CHECK(gap_m(drive) == relative(20.0 + touching_m, 0.01));
      CHECK(drive.a().speed_mps == relative(10.0, 0.02));
      CHECK(drive.count_of("e", ElementTransition::end) == (continuous ? 0 : 1));
    }
  }
}

TEST_CASE("who is faster than a distance allows slows down within its bounds") {
  const std::string slow = R"(<DynamicConstraints maxAcceleration="2" maxDeceleration="3" maxSpeed="12"/>)";
  Drive drive = drive_with(cars(300, 12), gap_text("distance=\"20\" freespace=\"true\"", slow, true));
  drive.run_until(1.0);
  CHECK(drive.a().speed_mps == doctest::Approx(17.0));
  drive.run_until(5.0);
  CHECK(drive.a().speed_mps == doctest::Approx(12.0));
}

TEST_CASE("one may also be ahead, or behind by a time") {
  Drive ahead = drive_with(
      cars(-60, 15),
      gap_text("distance=\"30\" freespace=\"false\" displacement=\"leadingReferencedEntity\"", gentle, true));
  ahead.run_until(40.0);
  CHECK(gap_m(ahead) == relative(-30.0, 0.005));
  CHECK(ahead.a().speed_mps == relative(15.0, 0.005));
  Drive any = drive_with(cars(-60, 15), gap_text("distance=\"30\" freespace=\"false\" displacement=\"any\"", "", true));
  any.run_until(1.0);
  CHECK(gap_m(any) == doctest::Approx(-30.0));
  Drive timed = drive_with(cars(100, 15), gap_text("timeGap=\"2\" freespace=\"true\"", gentle, true));
  timed.run_until(40.0);
  CHECK(gap_m(timed) == relative(2.0 * 15.0 + touching_m, 0.005));
}

TEST_CASE("jerk limits of a distance are kept") {
  const std::string limits =
      R"(<DynamicConstraints maxSpeed="30" maxDeceleration="3" maxAcceleration="3" maxAccelerationRate="1" maxDecelerationRate="1"/>)";
  Drive drive = drive_with(cars(80, 10), gap_text("timeGap=\"2\" freespace=\"true\"", limits, true));
  double before = 0.0, least = 1e9;
  while (drive.state.time_s < 45.0) {
    drive.run_until(drive.state.time_s + 0.01);
    const double a = drive.a().acceleration_mps2;
    CHECK(std::abs(a - before) <= 0.01 + 1e-6);
    CHECK(std::abs(a) <= 3.0 + 1e-6);
    before = a;
    least = std::min(least, gap_m(drive));
  }
  CHECK(least > touching_m);
  CHECK(gap_m(drive) == relative(20.0 + touching_m, 0.02));
}

TEST_CASE("a lateral distance is had on the side that is named") {
  const auto left_after = [&](const std::string& attributes, const std::string& limits, double time_s) {
    Drive drive = drive_with(cars(0, 20, -1), beside_text(attributes, limits, true));
    drive.run_until(time_s);
    return left_m(drive);
  };
  CHECK(left_after("freespace=\"false\" distance=\"2\"", "", 1.0) == doctest::Approx(-2.0));
  CHECK(left_after("freespace=\"true\" distance=\"1\" coordinateSystem=\"road\"", "", 1.0) == doctest::Approx(-2.8));
  CHECK(left_after("freespace=\"true\" distance=\"1\" displacement=\"leftToReferencedEntity\"", "", 1.0) ==
        doctest::Approx(2.8));
  // From 3.5 m to 1.5 m at 0.5 m/s.
  const std::string slow = R"(<DynamicConstraints maxSpeed="0.5"/>)";
  CHECK(left_after("freespace=\"false\" distance=\"1.5\"", slow, 2.0) == relative(-2.5, 0.01));
  CHECK(left_after("freespace=\"false\" distance=\"1.5\"", slow, 6.0) == doctest::Approx(-1.5));
}

TEST_CASE("a lateral distance follows one who moves within its bounds and ends where it is reached") {
  const std::string limits = R"(<DynamicConstraints maxSpeed="3" maxAcceleration="4" maxDeceleration="4"/>)";
  Drive drive = drive_with(
      cars(0, 20, -1),
      beside_text("freespace=\"true\" distance=\"0.5\" displacement=\"rightToReferencedEntity\"", limits, true));
  drive.run_until(8.0);
  CHECK(left_m(drive) == relative(-2.3, 0.01));
  const double before = drive.a().world_from_entity.position_m.y;
  drive.state.entities[1].lane.offset_m -= 1.0;
  drive.run_until(12.0);
  CHECK(left_m(drive) == relative(-2.3, 0.01));
  CHECK(drive.a().world_from_entity.position_m.y == relative(before - 1.0, 0.01));
  Drive once = drive_with(cars(0, 20, -1), beside_text("freespace=\"false\" distance=\"2\"", limits, false));
  once.run_until(6.0);
  CHECK(once.count_of("e", ElementTransition::end) == 1);
  CHECK(left_m(once) == relative(-2.0, 0.04));
}

TEST_CASE("both ways of a meeting have the same strength and lead there in time") {
  for (const double way : {60.0, 100.0, 140.0, 30.0}) {
    for (const double final_mps : {5.0, 15.0}) {
      CAPTURE(way);
      CAPTURE(final_mps);
      double v = 10.0, s = way, strongest = 0.0, least = 1e9;
      const double dt = 0.01;
      for (double t = 10.0; t > dt / 2.0; t -= dt) {
        const double next = next_meeting_mps({s, t, final_mps}, v, dt);
        strongest = std::max(strongest, std::abs(next - v) / dt);
        least = std::min(least, next);
        s -= 0.5 * (v + next) * dt;
        v = next;
      }
      CHECK(std::abs(s) < 0.05);
      CHECK(v == relative(final_mps, 0.01));
      CHECK(least >= 0.0);
      CHECK(strongest < 6.0);
    }
  }
}

TEST_CASE("two entities are at their places at the same time") {
  const auto meeting = [&](const std::string& content, const std::string& attributes = "") {
    return "<PrivateAction><SynchronizeAction masterEntityRef=\"B\" " + attributes +
           "><TargetPositionMaster><LanePosition roadId=\"R\" laneId=\"-1\" s=\"500\"/></TargetPositionMaster>"
           "<TargetPosition><LanePosition roadId=\"R\" laneId=\"-2\" s=\"420\"/></TargetPosition>" +
           content + "</SynchronizeAction></PrivateAction>";
  };
  // B needs 20 s for its 300 m, A has 320 m.
  const auto arrive = [&](const std::string& content, double& speed_mps) {
    Drive drive = drive_with(cars(100, 15, -1), meeting(content));
    while (drive.b().world_from_entity.position_m.x < 500.0) drive.run_until(drive.state.time_s + 0.01);
    speed_mps = drive.a().speed_mps;
    CHECK(drive.count_of("e", ElementTransition::end) == 1);
    return drive.a().world_from_entity.position_m.x;
  };
  double speed = 0.0;
  CHECK(arrive("", speed) == relative(420.0, 0.001));
  CHECK(arrive("<FinalSpeed><AbsoluteSpeed value=\"12\"/></FinalSpeed>", speed) == relative(420.0, 0.001));
  CHECK(speed == relative(12.0, 0.01));
  CHECK(arrive("<FinalSpeed><RelativeSpeedToMaster value=\"2\" speedTargetValueType=\"factor\"/></FinalSpeed>",
               speed) == relative(420.0, 0.001));
  CHECK(speed == relative(30.0, 0.01));
  Drive steady = drive_with(
      cars(100, 15, -1),
      meeting(
          "<FinalSpeed><AbsoluteSpeed value=\"10\"><TargetTimeSteadyState time=\"5\"/></AbsoluteSpeed></FinalSpeed>"));
  steady.run_until(15.2);
  CHECK(steady.a().speed_mps == relative(10.0, 0.01));
  CHECK(steady.a().world_from_entity.position_m.x == relative(420.0 - 48.0, 0.001));
  // The master brakes in the middle: recomputed.
  Drive changed = drive_with(cars(100, 15, -1), meeting("<FinalSpeed><AbsoluteSpeed value=\"12\"/></FinalSpeed>"));
  changed.run_until(10.0);
  changed.state.entities[1].speed_mps = 5.0;
  while (changed.b().world_from_entity.position_m.x < 500.0) changed.run_until(changed.state.time_s + 0.01);
  CHECK(changed.a().world_from_entity.position_m.x == relative(420.0, 0.002));
  Drive tolerant = drive_with(cars(100, 15, -1), meeting("", "targetToleranceMaster=\"30\" targetTolerance=\"1\""));
  tolerant.run_until(20.0);
  CHECK(tolerant.time_of("e", ElementTransition::end) == relative(18.0, 0.01));
}

TEST_CASE("distances and profiles that say nothing are named") {
  const auto check = [&](const std::string& action) {
    std::string all;
    for (const Finding& finding :
         check_scenario(scenario_text(cars(50, 10), story_text(event_text("e", action, at_time(0.0)))), "test.xosc",
                        files_in(".")))
      all += describe(finding.error) + "\n";
    return all;
  };
  CHECK(check(gap_text("freespace=\"true\"", "", true)).find("names no distance") != std::string::npos);
  CHECK(check(gap_text("freespace=\"true\" distance=\"1\" timeGap=\"2\"", "", true)).find("the timeGap is taken") !=
        std::string::npos);
  CHECK(check(gap_text("distance=\"1\"", "", true)).find("attribute freespace is missing") != std::string::npos);
  CHECK(check(gap_text("freespace=\"true\" distance=\"1\" coordinateSystem=\"trajectory\"", "", true))
            .find("\"road\" is taken") != std::string::npos);
  CHECK(check(gap_text("freespace=\"true\" distance=\"-1\"", "", true)).find("out of its range") != std::string::npos);
  CHECK(check(profile_text("follow", "")).find("it has no speeds") != std::string::npos);
  CHECK(check("<PrivateAction><SynchronizeAction masterEntityRef=\"B\"/></PrivateAction>")
            .find("<TargetPosition> is missing") != std::string::npos);
}

TEST_CASE("a lateral distance along the road is had on the named side by who drives against the road's direction too") {
  const std::string init =
      private_text("A", place_text(2, 1000) + speed_text(20)) + private_text("B", place_text(1, 1000) + speed_text(20));
  for (const std::string system : {"", " coordinateSystem=\"road\""}) {
    Drive drive = drive_with(init, beside_text("freespace=\"false\" distance=\"2\"" + system, "", true));
    drive.run_until(1.0);
    CHECK(left_m(drive) == doctest::Approx(2.0));
  }
}

TEST_CASE("a time gap is that of who is behind") {
  Drive drive = drive_with(cars(-60, 15), speed_text(20), 1e3);
  KeepDistanceAction what;
  what.reference = 1;
  what.time_gap_s = 2.0;
  what.freespace = false;
  const auto way_m = [&](double side, EntityIndex actor) {
    what.reference = 1 - actor;
    return way_to_distance_m(drive.network, drive.scenario, drive.state, what, side, actor).value();
  };
  CHECK(way_m(-1.0, 0) == doctest::Approx(-60.0 + 2.0 * 15.0));  // A, ahead, at the distance that B wants.
  CHECK(way_m(1.0, 1) == doctest::Approx(60.0 - 2.0 * 15.0));
}

}  // namespace septet::scenario
