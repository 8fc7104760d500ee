// Steps within one road: each profile that can make one, from 0.05 m on, with road and s; and intended steps in
// silence.
#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "road_files.hpp"

namespace septet::road {
namespace {

std::vector<std::string> steps_of(const std::string& xml) {
  std::vector<std::string> texts;
  for (const Finding& finding : check_opendrive(xml, "steps.xodr"))
    if (finding.error.what.find("step") != std::string::npos) {
      CHECK(finding.severity == Severity::warning);
      CHECK(finding.line > 0);
      CHECK_FALSE(finding.error.remedy.empty());
      texts.push_back(finding.error.what);
    }
  return texts;
}

using Texts = std::vector<std::string>;

std::string cubic(const char* element, double s, double a, double b = 0.0) {
  return fmt::format("<{} s=\"{}\" a=\"{}\" b=\"{}\" c=\"0\" d=\"0\"/>", element, s, a, b);
}

/// 100 m, one lane each way; the elevation rises by `step_m` at s = 20.
std::string raised_by(double step_m) {
  SmallRoad road;
  road.profiles = "<elevationProfile>" + cubic("elevation", 0, 1.0, 0.02) + cubic("elevation", 20, 1.4 + step_m, 0.02) +
                  "</elevationProfile>";
  return road.xml();
}

/// Two sections; at s = 50 the second begins with `inside` in its right lane.
std::string two_sections(const std::string& before, const std::string& first, const std::string& second) {
  SmallRoad road;
  road.before_sections = before;
  const auto section = [&](int s, const std::string& lanes) {
    return fmt::format("<laneSection s=\"{}\"><center>{}</center><right>{}</right></laneSection>", s, lane(0, 0),
                       lanes);
  };
  road.sections = section(0, first) + section(50, second);
  return road.xml();
}

}  // namespace

TEST_CASE("a step in a road's elevation is named from 0.05 m on with road, s and cause") {
  CHECK(steps_of(raised_by(0.0)) == Texts{});
  CHECK(steps_of(raised_by(0.049)) == Texts{});
  for (const double step_m : {0.051, -0.051, 0.5, -3.0, 30.0}) {
    CAPTURE(step_m);
    const Texts found = steps_of(raised_by(step_m));
    REQUIRE(found.size() == 1);
    CHECK(found[0].starts_with(fmt::format("the surface of road a steps by {:.3f} m at s=20.000, t=", step_m)));
    CHECK(found[0].ends_with("by its elevation"));
  }
}

TEST_CASE("a slope that ends, a crest and a record that repeats another are no steps") {
  SmallRoad road;
  road.profiles = "<elevationProfile>" + cubic("elevation", 0, 0.0, 0.1) + cubic("elevation", 40, 4.0, -0.1) +
                  cubic("elevation", 60, 2.0, 0.0) + cubic("elevation", 80, 2.0, 0.0) + "</elevationProfile>";
  CHECK(steps_of(road.xml()) == Texts{});
}

TEST_CASE("a step of the superelevation counts by the height that it makes at the lanes' borders") {
  const auto rolled_by = [](double roll_rad) {
    SmallRoad road;
    road.profiles = "<lateralProfile>" + cubic("superelevation", 0, 0.0) + cubic("superelevation", 30, roll_rad) +
                    "</lateralProfile>";
    return steps_of(road.xml());
  };
  CHECK(rolled_by(0.01) == Texts{});  // 3.5 cm at 3.5 m.
  const Texts found = rolled_by(0.05);
  REQUIRE(found.size() == 1);
  CHECK(found[0].find("at s=30.000") != std::string::npos);
  CHECK(found[0].ends_with("by its superelevation"));
}

TEST_CASE("a step of the shape across the road is named where it lies and not beyond the lanes") {
  const auto shaped = [](double t_m, double a_m) {
    SmallRoad road;
    const auto shape = [](double t, double a) {
      return fmt::format("<shape s=\"0\" t=\"{}\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", t, a);
    };
    road.profiles = "<lateralProfile>" + shape(-10, 0.0) + shape(t_m, a_m) + "</lateralProfile>";
    return steps_of(road.xml());
  };
  CHECK(shaped(1.0, 0.04) == Texts{});
  CHECK(shaped(6.0, 0.5) == Texts{});
  const Texts found = shaped(1.0, 0.2);
  REQUIRE(found.size() == 1);
  CHECK(found[0] == "the surface of road a steps by 0.200 m at s=0.000, t=1.000, by its shape");
}

TEST_CASE("a step of a driving lane's height is named and a lowered kerb of a pavement is not") {
  const auto lane_of = [](const char* type) {
    return lane(-1, 3.5,
                "<height sOffset=\"0\" inner=\"0.0\" outer=\"0.0\"/><height sOffset=\"20\" inner=\"0.12\" "
                "outer=\"0.12\"/>",
                type);
  };
  SmallRoad road;
  const auto with = [&](const std::string& lanes) {
    road.sections =
        "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lanes + "</right></laneSection>";
    return steps_of(road.xml());
  };
  const Texts found = with(lane_of("driving"));
  REQUIRE(found.size() == 1);
  CHECK(found[0].ends_with("by its lane height"));
  CHECK(with(lane_of("sidewalk")) == Texts{});
}

TEST_CASE("a lane offset that moves the lanes is named and one that renumbers them is not") {
  const std::string moved = cubic("laneOffset", 0, 0.0) + cubic("laneOffset", 50, -3.5);
  const std::string goes_on = "<link><successor id=\"-1\"/></link>", from_1 = "<link><predecessor id=\"-1\"/></link>";
  SmallRoad road;
  road.before_sections = cubic("laneOffset", 0, 0.0) + cubic("laneOffset", 40, 0.3);
  const Texts found = steps_of(road.xml());
  REQUIRE(found.size() == 1);
  CHECK(found[0] == "the lanes of road a step sideways by 0.300 m at s=40.000, by its laneOffset");
  const std::string two_lanes = lane(-1, 3.5, "<link/>") + lane(-2, 3.5, "<link><successor id=\"-1\"/></link>");
  const std::string other = lane(-1, 3.5, "<link><predecessor id=\"-2\"/></link>");
  CHECK(steps_of(two_sections(moved, two_lanes, other)) == Texts{});
  CHECK(steps_of(two_sections(moved, lane(-1, 3.5, goes_on), lane(-1, 3.5, from_1))).size() == 1);
}

TEST_CASE("a step of a driving lane's width is named and one of a lane that begins or of a shoulder is not") {
  const auto found = [](double before_m, double after_m, const std::string& type = "driving") {
    SmallRoad road;
    const auto width = [](double s_m, double a_m) {
      return fmt::format("<width sOffset=\"{}\" a=\"{}\" b=\"0\" c=\"0\" d=\"0\"/>", s_m, a_m);
    };
    road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right><lane id=\"-1\" type=\"" + type +
                    "\">" + width(0, before_m) + width(40, after_m) + "</lane></right></laneSection>";
    Texts texts;
    for (const Finding& finding : check_opendrive(road.xml(), "steps.xodr"))
      if (finding.error.what.find(" m wide before ") != std::string::npos) {
        CHECK(finding.severity == Severity::warning);
        CHECK(finding.line > 0);
        texts.push_back(finding.error.what);
      }
    return texts;
  };
  CHECK(found(3.5, 3.54) == Texts{});
  CHECK(found(3.5, 3.56) == Texts{"lane -1 of road a is 3.500 m wide before s=40.000 and 3.560 m behind it"});
  CHECK(found(3.5, 1.0).size() == 1);
  CHECK(found(0.0, 3.5) == Texts{});
  CHECK(found(3.5, 2.0, "shoulder") == Texts{});
}

}  // namespace septet::road
