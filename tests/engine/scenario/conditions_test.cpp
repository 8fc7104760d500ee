// Conditions one by one, and their times.

#include <string>

#include <doctest/doctest.h>

#include "engine/scenario/run/entity_distance.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"
#include "tests/why_not.hpp"

namespace septet::scenario {
namespace {

std::string standing(const std::string& entity, int lane, double s_m, double speed_mps = 0.0) {
  return private_text(entity, place_text(lane, s_m) + speed_text(speed_mps));
}

/// True if A's condition holds at the first step.
bool holds(const std::string& condition, const std::string& init) {
  Drive drive(
      scenario_text(init, story_text(event_text("e", speed_text(20), trigger_text(of_entity_text("A", condition))))));
  drive.run_until(0.015);
  return drive.count_of("e", ElementTransition::start) == 1;
}

/// Front 3.7 m before, rear 0.9 m behind a car's place.
std::string clearance(const std::string& attributes, const std::string& children = "") {
  return "<RelativeClearanceCondition " + attributes + ">" + children + "</RelativeClearanceCondition>";
}
std::string lanes(int from, int to) {
  return "<RelativeLaneRange from=\"" + std::to_string(from) + "\" to=\"" + std::to_string(to) + "\"/>";
}

}  // namespace

TEST_CASE("a clearance is that ahead to who is ahead and that behind to who is behind") {
  const std::string free =
      clearance(R"(freeSpace="true" oppositeLanes="false" distanceForward="30" distanceBackward="10")");
  const auto with_b_at = [&](double s_m) { return holds(free, standing("A", -2, 100.0) + standing("B", -2, s_m)); };
  CHECK_FALSE(with_b_at(134.5));  // 29.9 m from bumper to bumper.
  CHECK(with_b_at(134.7));
  CHECK_FALSE(with_b_at(85.5));
  CHECK(with_b_at(85.3));
  const std::string of_origins =
      clearance(R"(freeSpace="false" oppositeLanes="false" distanceForward="30" distanceBackward="10")");
  const auto between_origins = [&](double s_m) {
    return holds(of_origins, standing("A", -2, 100.0) + standing("B", -2, s_m));
  };
  CHECK_FALSE(between_origins(129.9));
  CHECK(between_origins(130.1));
  CHECK_FALSE(between_origins(90.1));
  CHECK(between_origins(89.9));
}

TEST_CASE("a clearance looks in its lanes alone and a lane that is not there has no room") {
  const std::string attributes = R"(freeSpace="true" oppositeLanes="false" distanceForward="30" distanceBackward="10")";
  const auto with_b_in = [&](int lane, const std::string& ranges) {
    return holds(clearance(attributes, ranges), standing("A", -2, 100.0) + standing("B", lane, 110.0));
  };
  CHECK(with_b_in(-1, lanes(0, 0)));
  CHECK_FALSE(with_b_in(-1, lanes(0, 1)));  // Positive is to the left.
  CHECK_FALSE(with_b_in(-1, lanes(1, 1)));
  CHECK(with_b_in(-1, lanes(-1, -1)));
  CHECK_FALSE(with_b_in(-3, lanes(-1, -1)));
  CHECK_FALSE(with_b_in(-3, ""));
  CHECK_FALSE(with_b_in(-1, lanes(-1, -1) + lanes(1, 1)));
  CHECK(holds(clearance(attributes, lanes(1, 1)), standing("A", -3, 100.0) + standing("B", -1, 110.0)));
  CHECK_FALSE(holds(clearance(attributes, lanes(-1, -1)), standing("A", -3, 100.0) + standing("B", -1, 110.0)));
}

TEST_CASE("a clearance minds oncoming traffic and those not named only where it says so") {
  const std::string distances = R"( distanceForward="30" distanceBackward="10" freeSpace="true")";
  const std::string init = standing("A", -1, 100.0) + standing("B", 1, 110.0);
  CHECK(holds(clearance(R"(oppositeLanes="false")" + distances), init));
  CHECK_FALSE(holds(clearance(R"(oppositeLanes="true")" + distances), init));
  const std::string beside = standing("A", -1, 100.0) + standing("B", -2, 110.0);
  CHECK_FALSE(holds(clearance(R"(oppositeLanes="false")" + distances, R"(<EntityRef entityRef="B"/>)"), beside));
  CHECK(holds(clearance(R"(oppositeLanes="false")" + distances, R"(<EntityRef entityRef="A"/>)"), beside));
}

TEST_CASE("a time headway is the distance over one's own speed and without end for who stands") {
  const auto headway = [](const std::string& rule, double value) {
    return R"(<TimeHeadwayCondition entityRef="B" freespace="false" coordinateSystem="road" relativeDistanceType="longitudinal" rule=")" +
           rule + "\" value=\"" + std::to_string(value) + "\"/>";
  };
  const std::string driving = standing("A", -2, 100.0, 20.0) + standing("B", -2, 200.0, 10.0);
  CHECK(holds(headway("lessThan", 5.1), driving));
  CHECK_FALSE(holds(headway("lessThan", 4.9), driving));
  const std::string stopped = standing("A", -2, 100.0) + standing("B", -2, 200.0, 10.0);
  CHECK(holds(headway("greaterThan", 1e6), stopped));
  CHECK_FALSE(holds(headway("lessThan", 1e6), stopped));
}

TEST_CASE("the first look at a condition is no edge") {
  const auto count = [](const std::string& condition, const std::string& edge) {
    Drive drive(
        scenario_text(standing("A", -2, 100.0) + standing("B", -2, 200.0),
                      story_text(event_text("e", speed_text(0), trigger_text(condition, edge), "parallel", 9))));
    drive.run_until(3.0);
    return std::pair(drive.count_of("e", ElementTransition::start), drive.time_of("e", ElementTransition::start));
  };
  const std::string before_1_s =
      "<ByValueCondition><SimulationTimeCondition rule=\"lessThan\" value=\"1\"/></ByValueCondition>";
  CHECK(count(before_1_s, "rising").first == 0);
  CHECK(count(before_1_s, "falling").first == 1);
  CHECK(count(before_1_s, "falling").second == doctest::Approx(1.0));
  CHECK(count(before_1_s, "risingOrFalling").first == 1);
  CHECK(count(time_text(1.0), "falling").first == 0);
  CHECK(count(time_text(1.0), "risingOrFalling").first == 1);
}

TEST_CASE("speeds and accelerations are compared along their direction and against the other's") {
  const std::string init = standing("A", -2, 100.0, 20.0) + standing("B", -2, 200.0, 15.0);
  const auto speed = [&](const std::string& more) { return holds("<SpeedCondition " + more + "/>", init); };
  CHECK(speed(R"(rule="greaterThan" value="19.9")"));
  CHECK_FALSE(speed(R"(rule="greaterThan" value="20.1")"));
  CHECK(speed(R"(rule="equalTo" value="20")"));
  CHECK(speed(R"(direction="longitudinal" rule="greaterOrEqual" value="19.99")"));
  CHECK(speed(R"(direction="lateral" rule="lessThan" value="0.01")"));
  CHECK(speed(R"(direction="vertical" rule="lessThan" value="0.01")"));
  const auto relative = [&](const std::string& more) {
    return holds("<RelativeSpeedCondition entityRef=\"B\" " + more + "/>", init);
  };
  CHECK(relative(R"(rule="greaterThan" value="4.9")"));
  CHECK(relative(R"(rule="lessThan" value="5.1")"));
}

TEST_CASE("a time to collision is the distance over the closing speed and never for what does not come nearer") {
  const auto collision = [](const std::string& rule, double value) {
    return R"(<TimeToCollisionCondition freespace="false" rule=")" + rule + "\" value=\"" + std::to_string(value) +
           R"("><TimeToCollisionConditionTarget><EntityRef entityRef="B"/></TimeToCollisionConditionTarget></TimeToCollisionCondition>)";
  };
  const std::string closing = standing("A", -2, 100.0, 20.0) + standing("B", -2, 200.0, 10.0);
  CHECK(holds(collision("lessThan", 10.1), closing));
  CHECK_FALSE(holds(collision("lessThan", 9.9), closing));
  const std::string apart = standing("A", -2, 100.0, 10.0) + standing("B", -2, 200.0, 20.0);
  CHECK_FALSE(holds(collision("lessThan", 1e6), apart));
  CHECK_FALSE(holds(collision("greaterThan", 1.0), apart));
}

TEST_CASE("who stands is seen so after the duration and a place is reached within its tolerance") {
  const std::string init = standing("A", -2, 100.0) + standing("B", -2, 200.0, 10.0);
  const auto time_of = [&](const std::string& entity, const std::string& condition) {
    Drive drive(scenario_text(
        init, story_text(event_text("e", speed_text(0), trigger_text(of_entity_text(entity, condition))))));
    drive.run_until(6.0);
    return drive.time_of("e", ElementTransition::start);
  };
  CHECK(time_of("A", R"(<StandStillCondition duration="2"/>)") == relative(2.0, 0.01));
  CHECK(time_of("B", R"(<StandStillCondition duration="2"/>)") < 0.0);
  const std::string place =
      R"(<ReachPositionCondition tolerance="5"><Position><LanePosition roadId="R" laneId="-2" s="225"/></Position></ReachPositionCondition>)";
  CHECK(time_of("B", place) == relative(2.0, 0.01));
  CHECK(time_of("B", R"(<TraveledDistanceCondition value="20"/>)") == relative(2.0, 0.01));
}

TEST_CASE("a condition of several entities holds for any or for all as it says") {
  const std::string init = standing("A", -2, 100.0, 20.0) + standing("B", -2, 200.0, 10.0);
  const auto both = [&](const std::string& rule) {
    const std::string condition =
        "<ByEntityCondition><TriggeringEntities triggeringEntitiesRule=\"" + rule +
        R"("><EntityRef entityRef="A"/><EntityRef entityRef="B"/></TriggeringEntities><EntityCondition>)" +
        R"(<SpeedCondition rule="greaterThan" value="15"/></EntityCondition></ByEntityCondition>)";
    Drive drive(scenario_text(init, story_text(event_text("e", speed_text(20), trigger_text(condition)))));
    drive.run_until(0.015);
    return drive.count_of("e", ElementTransition::start) == 1;
  };
  CHECK(both("any"));
  CHECK_FALSE(both("all"));
}

TEST_CASE("a distance in lane coordinates is along the lanes, in road coordinates along the reference line") {
  const auto network = test_road(road_text(R"(<arc curvature="0.01"/>)"));
  const road::LanePosition outer{0, -3, 100.0, 0.0}, inner{0, 3, 100.0, 0.0};
  const auto at = [](road::LanePosition position, double s_m) {
    position.s_m = s_m;
    return position;
  };
  CHECK(road_distance_m(network, outer, true, at(outer, 200.0)) == doctest::Approx(100.0));
  CHECK(road_distance_m(network, outer, true, at(outer, 200.0), true) == relative(100.0 * 1.0875, 1e-9));
  CHECK(road_distance_m(network, outer, true, at(outer, 50.0), true) == relative(-50.0 * 1.0875, 1e-9));
  CHECK(road_distance_m(network, inner, false, at(inner, 50.0), true) == relative(50.0 * 0.9125, 1e-9));
  CHECK(road_distance_m(network, inner, true, at(inner, 150.0), true) == relative(50.0 * 0.9125, 1e-9));
}

TEST_CASE("what is behind on the next road is behind in either direction of driving") {
  const auto straight = [](const std::string& id, double x_m, double length_m, const std::string& link) {
    return road::SmallRoad{.length_m = length_m,
                           .sections = road::lane_section(road::left_lanes(1), road::right_lanes(1)),
                           .id = id,
                           .link = link,
                           .x_m = x_m}
        .text();
  };
  const auto network =
      road::read_opendrive(road::roads_text(straight("p", 0.0, 100.0, road::link_to_road("successor", "q", "start")) +
                                            straight("q", 100.0, 200.0, road::link_to_road("predecessor", "p", "end"))),
                           "two.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  const road::LanePosition on_p{0, 1, 30.0, 0.0}, on_q{1, 1, 50.0, 0.0};
  CHECK(road_distance_m(*network, on_p, true, on_q) == doctest::Approx(120.0));
  CHECK(road_distance_m(*network, on_p, false, on_q) == doctest::Approx(-120.0));
  CHECK(road_distance_m(*network, on_q, true, on_p) == doctest::Approx(-120.0));
  CHECK(road_distance_m(*network, on_q, false, on_p) == doctest::Approx(120.0));
}

}  // namespace septet::scenario
