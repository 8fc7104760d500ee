// Numbers impossible for a road: one message with the line, and no later stage ever sees them.
#include "engine/road/road_limits.hpp"

#include <doctest/doctest.h>

#include "road_files.hpp"

namespace septet::road {
namespace {

/// The one finding of a file.
Finding only_finding(const std::string& xml) {
  const auto findings = check_opendrive(xml, "hostile.xodr");
  CAPTURE(xml);
  for (const Finding& finding : findings) CAPTURE(finding.error.what);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].line > 0);
  CHECK_FALSE(findings[0].error.remedy.empty());
  return findings[0];
}

/// Of an edition that requires no attributes.
std::string oldest(const std::string& xml) { return replaced(xml, "revMinor=\"8\"", "revMinor=\"4\""); }

std::string with_objects(const std::string& objects) {
  return replaced(oldest(SmallRoad{}.xml()), "</road>", objects + "</road>");
}

std::string with_mark(const std::string& mark) {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0, mark) + "</center><right>" + lane(-1, 3.5) +
                  "</right></laneSection>";
  return oldest(road.xml());
}

}  // namespace

TEST_CASE("a number that no road holds is refused with its line") {
  const std::string elevation =
      "<elevationProfile><elevation s=\"0\" a=\"A\" b=\"B\" c=\"0\" "
      "d=\"0\"/></elevationProfile>";
  const auto with_elevation = [&](const char* a, const char* b) {
    return SmallRoad{.profiles = replaced(replaced(elevation, "A", a), "B", b)}.xml();
  };
  SmallRoad offset{.before_sections = "<laneOffset s=\"0\" a=\"1e9\" b=\"0\" c=\"0\" d=\"0\"/>"};
  SmallRoad cubic{.geometry =
                      "<paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"100\" cU=\"0\" "
                      "dU=\"0\" aV=\"1e12\" bV=\"0\" cV=\"0\" dV=\"0\"/>"};
  SmallRoad high;
  high.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 3.5, "<height sOffset=\"0\" inner=\"1e9\" outer=\"0\"/>") + "</right></laneSection>";
  SmallRoad shaped{.profiles =
                       "<lateralProfile><shape s=\"0\" t=\"0\" a=\"0\" b=\"0\" c=\"1e6\" "
                       "d=\"0\"/></lateralProfile>"};
  const std::pair<std::string, const char*> faults[] = {
      {SmallRoad{.header = "<offset x=\"1e11\" y=\"0\" z=\"0\" hdg=\"0\"/>"}.xml(),
       "x=\"1e11\" is not a number within ±100000000"},
      {SmallRoad{.header = "<offset x=\"0\" y=\"0\" z=\"-3e4\" hdg=\"0\"/>"}.xml(),
       "z=\"-3e4\" is not a number within ±20000"},
      {replaced(SmallRoad{}.xml(), "x=\"0\"", "x=\"-2e8\""), "x=\"-2e8\" is not a number within ±100000000"},
      {cubic.xml(), "its curve leaves the world"},
      {high.xml(), "inner=\"1e9\" is not a number within ±1000"},
      {with_elevation("1e11", "0"), "the elevation from s=0 reaches 1e+11 m"},
      {with_elevation("0", "900"), "the elevation from s=0 reaches 9e+04 m"},
      {offset.xml(), "the lane offset from s=0 reaches 1e+09 m"},
      {shaped.xml(), "the surface stands 1.225e+07 m above the road at s=0.000, t=-3.500"},
      {with_objects("<signals><signal id=\"1\" s=\"5\" t=\"1\" height=\"1e9\"/></signals>"),
       "height=\"1e9\" is not a number within ±1000"},
      {with_objects("<objects><object id=\"1\" s=\"5\" t=\"1e9\"/></objects>"),
       "t=\"1e9\" is not a number within ±10000"},
  };
  for (const auto& [xml, what] : faults) {
    const Finding finding = only_finding(xml);
    CHECK(finding.severity == Severity::error);
    CHECK(finding.error.what == what);
  }
}

TEST_CASE("more lanes than a road can hold are refused before they are read") {
  std::string lanes;
  for (int i = 1; i <= 10'000; ++i) lanes += lane(-i, 3.5);
  SmallRoad road{.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lanes +
                             "</right></laneSection>"};
  CHECK(only_finding(road.xml()).error.what == "there are more than 100 lanes");
}

TEST_CASE("what reaches beyond the road is cut off at its end, a size that is none left out, and both said") {
  const auto read = [](const std::string& inside, const char* what) {
    const std::string xml = with_objects(inside);
    const Finding finding = only_finding(xml);
    CHECK(finding.severity == Severity::warning);
    CHECK(finding.error.what == what);
    return read_or_fail(xml).roads[0];
  };
  const Road tunnel = read("<objects><tunnel id=\"1\" s=\"20\" length=\"1e9\"/></objects>",
                           "it reaches 1e+09 m beyond the road; it is cut off there");
  CHECK(tunnel.structures.at(0).length_m == 80.0);
  const Road bridge = read("<objects><bridge id=\"1\" s=\"-1e9\" length=\"30\"/></objects>",
                           "s=-1000000000 is beyond the road, which is 100 m long; it is taken to its end");
  CHECK(bridge.structures.at(0).s_m == 0.0);
  CHECK(bridge.structures.at(0).length_m == 30.0);
  const Road nothing =
      read("<objects><tunnel id=\"1\" s=\"20\" length=\"-5\"/></objects>", "length=-5 is below 0; it is taken as 0");
  CHECK(nothing.structures.empty());
  const Road rail = read(
      "<objects><object id=\"1\" s=\"0\" t=\"1\"><repeat s=\"10\" length=\"1e9\" "
      "distance=\"0\"/></object></objects>",
      "it reaches 1e+09 m beyond the road; it is cut off there");
  CHECK(rail.objects.at(0).repeats.at(0).length_m == 90.0);
  const Road posts = read(
      "<objects><object id=\"1\" s=\"0\" t=\"1\"><repeat s=\"10\" length=\"20\" "
      "distance=\"1e-9\"/></object></objects>",
      "distance=1e-09; it is taken as one continuous object");
  CHECK(posts.objects.at(0).repeats.at(0).distance_m == 0.0);
  const Road box = read("<objects><object id=\"1\" s=\"0\" t=\"1\" width=\"-2\"/></objects>",
                        "width=-2 is below 0; it is taken as 0");
  CHECK(box.objects.at(0).width_m == 0.0);
  const Road tree = read("<objects><object id=\"1\" s=\"0\" t=\"1\" height=\"nan\" radius=\"2\"/></objects>",
                         "height is not a number; it is taken as not given");
  CHECK(tree.objects.at(0).height_m == 0.0);
  CHECK(tree.objects.at(0).radius_m == 2.0);
  const Road sign = read("<signals><signal id=\"1\" s=\"100.5\" t=\"1\"/></signals>",
                         "s=100.5 is beyond the road, which is 100 m long; it is taken to its end");
  CHECK(sign.signals.at(0).s_m == 100.0);
}

TEST_CASE("dashes too short to be painted are left out and said") {
  const std::string mark =
      "<roadMark sOffset=\"0\" type=\"broken\"><type name=\"x\"><line "
      "length=\"1e-9\" space=\"1e-9\"/></type></roadMark>";
  const Finding finding = only_finding(with_mark(mark));
  CHECK(finding.severity == Severity::warning);
  CHECK(finding.error.what == "its dashes are 1e-09 m long; it is left out");
  const RoadNetwork network = read_or_fail(with_mark(mark));
  const auto& lines = network.roads[0].sections[0].lane(0).marks.at(0).lines;
  REQUIRE(lines.size() == 1);
  CHECK(lines[0].length_m + lines[0].space_m > 1.0);
}

TEST_CASE("what no car can drive on is said and read") {
  SmallRoad steep{.profiles =
                      "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"50\" c=\"0\" "
                      "d=\"0\"/></elevationProfile>"};
  CHECK(only_finding(steep.xml()).error.what == "the road from s=0 climbs 50 m in a metre");
  SmallRoad folded{.length_m = 6.0, .geometry = "<arc curvature=\"0.5\"/>"};
  const Finding finding = only_finding(folded.xml());
  CHECK(finding.severity == Severity::warning);
  CHECK(finding.error.what == "the lanes fold over at s=0.000: they reach 3 m inside a curve of 2 m");
}

}  // namespace septet::road
