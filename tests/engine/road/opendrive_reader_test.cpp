#include "engine/road/opendrive_reader.hpp"

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "road_files.hpp"

namespace septet::road {
namespace {

Finding only_error(const std::string& xml) {
  Finding error;
  int errors = 0;
  for (const Finding& finding : check_opendrive(xml, "broken.xodr")) {
    if (finding.severity == Severity::error && errors++ == 0) error = finding;
  }
  CHECK(errors >= 1);
  CHECK_FALSE(read_opendrive(xml, "broken.xodr").has_value());
  return error;
}

}  // namespace

TEST_CASE("a small road without faults gives no findings") {
  CHECK(check_opendrive(SmallRoad{}.xml(), "small.xodr").empty());
}

TEST_CASE("an error names file and line and element and says what to do") {
  const Finding finding =
      only_error(replaced(SmallRoad{}.xml(), "length=\"100\">\n<line/>", "length=\"ten\">\n<line/>"));
  CHECK(finding.line == 4);
  CHECK(finding.error.where == "broken.xodr:4, <geometry>");
  CHECK(finding.error.what == "length=\"ten\" is not a number within ±1000000");
  CHECK_FALSE(finding.error.remedy.empty());
}

TEST_CASE("every kind of broken road is refused") {
  const std::string good = SmallRoad{}.xml();
  const std::pair<const char*, const char*> faults[] = {
      {"</OpenDRIVE>", ""},                     // Not well formed.
      {"road id=\"a\"", "road"},                // No id.
      {"s=\"0\" x=\"0\"", "s=\"0\""},           // No x.
      {"<line/>", "<circle/>"},                 // Unknown geometry.
      {"<line/>", "<arc curvature=\"nan\"/>"},  // Not finite.
      {"<line/>", "<arc curvature=\"1e9\"/>"},  // Turns without end.
      {"<line/>", "<paramPoly3 aU=\"0\"/>"},    // Coefficients missing.
      {"hdg=\"0\" length=\"100\"", "hdg=\"0\" length=\"-1\""},
      {"junction=\"-1\" length=\"100\"", "junction=\"-1\" length=\"1e300\""},
      {"<laneSection s=\"0\">", "<section>"},
      {"lane id=\"-1\"", "lane id=\"-2\""},  // A gap.
      {"lane id=\"-1\"", "lane id=\"1\""},   // Wrong side.
      {"lane id=\"-1\"", "lane id=\"99999999999999999999\""},
      {"a=\"3.5\"", "a=\"-0.2\""},  // Negative width.
      {"a=\"3.5\"", "a=\"1e9\""},
      {"<planView>",
       "<link><successor elementType=\"road\" elementId=\"a\" "
       "contactPoint=\"middle\"/></link><planView>"},
      {"<lanes>",
       "<lateralProfile><superelevation s=\"0\" a=\"2\" b=\"0\" c=\"0\" "
       "d=\"0\"/></lateralProfile><lanes>"},
  };
  for (const auto& [from, to] : faults) {
    std::string xml = replaced(good, from, to);
    CAPTURE(xml);
    if (std::string(to) == "<section>") xml = replaced(xml, "</laneSection>", "</section>");
    only_error(xml);
  }
  only_error("");
  only_error("<roads/>");
  only_error("<OpenDRIVE/>");
  only_error(replaced(good, "</road>",
                      "</road>" + good.substr(good.find("<road"), good.find("</road>") - good.find("<road") + 7)));
}

TEST_CASE("all faults of a file are found and not only the first") {
  const std::string xml = replaced(replaced(SmallRoad{}.xml(), "x=\"0\"", "x=\"here\""), "a=\"3.5\"", "a=\"-1\"");
  const auto findings = check_opendrive(xml, "two.xodr");
  REQUIRE(findings.size() == 2);
  CHECK(findings[0].line < findings[1].line);
}

TEST_CASE("the findings of a hopeless file are bounded") {
  std::string sections;
  for (int i = 0; i < 3000; ++i) sections += "<laneSection s=\"x\"/>";
  CHECK(check_opendrive(SmallRoad{.sections = sections}.xml(), "many.xodr").size() == 1000);
}

TEST_CASE("lanes may be given by their borders") {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) +
                  "</center><right><lane id=\"-1\" type=\"driving\"><border sOffset=\"0\" a=\"-3\" "
                  "b=\"-0.01\" c=\"0\" d=\"0\"/></lane>"
                  "<lane id=\"-2\" type=\"driving\"><border sOffset=\"0\" a=\"-7\" b=\"0\" c=\"0\" "
                  "d=\"0\"/></lane></right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  CHECK(lane_width_m(network, 0, -1, 50.0) == doctest::Approx(3.5));
  CHECK(lane_width_m(network, 0, -2, 50.0) == doctest::Approx(3.5));
  CHECK(evaluate_lane(network, {0, -2, 100.0, 0.0}).t_m == doctest::Approx(-5.5));
}

TEST_CASE("a section of one side goes on with the other side of the section before it") {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><left>" + lane(1, 3.0) + "</left><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 3.5) + "</right></laneSection><laneSection s=\"40\" singleSide=\"true\"><center>" +
                  lane(0, 0) + "</center><right>" + lane(-1, 3.5) + lane(-2, 2.0) + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  CHECK(lane_width_m(network, 0, 1, 70.0) == 3.0);
  CHECK(lane_width_m(network, 0, -2, 70.0) == 2.0);
  CHECK(continuations(network, 0, 0, 1, true).size() == 1);
}

TEST_CASE("left-hand traffic runs along s on the left") {
  const RoadNetwork right = read_or_fail(SmallRoad{}.xml()),
                    left = read_or_fail(SmallRoad{.attributes = "rule=\"LHT\""}.xml());
  CHECK(runs_along_s(right, {0, -1, 5.0, 0.0}));
  CHECK_FALSE(runs_along_s(right, {0, 1, 5.0, 0.0}));
  CHECK(runs_along_s(left, {0, 1, 5.0, 0.0}));
  CHECK_FALSE(runs_along_s(left, {0, -1, 5.0, 0.0}));
}

TEST_CASE("the offset of the header moves and turns and lifts the roads") {
  SmallRoad road{.header = "<offset x=\"10\" y=\"0\" z=\"3\" hdg=\"1.5707963267948966\"/>"};
  road.profiles = "<elevationProfile><elevation s=\"0\" a=\"1\" b=\"0\" c=\"0\" d=\"0\"/></elevationProfile>";
  const Vec3 start = evaluate(read_or_fail(road.xml()), {0, 0.0, 0.0}).position_m;
  CHECK(glm::distance(start, Vec3(0.0, 10.0, 4.0)) < 1e-12);
}

TEST_CASE("a road mark without lines gets those of its type and lasts until the next one") {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" +
                  lane(0, 0,
                       "<roadMark sOffset=\"0\" type=\"solid broken\" color=\"yellow\" width=\"0.1\"/>"
                       "<roadMark sOffset=\"30\" type=\"broken\" weight=\"bold\" color=\"white\"/>") +
                  "</center><right>" + lane(-1, 3.5) + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  const RoadMark* first = road_mark_at(network, 0, 0, 10.0);
  REQUIRE(first != nullptr);
  CHECK(first->color == RoadMarkColor::yellow);
  CHECK(first->s_end_m == 30.0);
  REQUIRE(first->lines.size() == 2);
  CHECK(first->lines[0].t_offset_m > 0.0);
  CHECK(first->lines[0].space_m == 0.0);
  CHECK(first->lines[1].space_m > 0.0);
  const RoadMark* second = road_mark_at(network, 0, 0, 60.0);
  REQUIRE(second != nullptr);
  CHECK(second->type == RoadMarkType::broken);
  CHECK(second->bold);
  CHECK(second->s_end_m == 100.0);
  CHECK(road_mark_at(network, 0, -1, 60.0) == nullptr);
}

TEST_CASE("a mark of type none has no lines and a line without a width gets that of its mark") {
  SmallRoad road;
  const std::string lines = "<type name=\"x\"><line length=\"2\" space=\"4\" width=\"0\"/></type></roadMark>";
  road.sections = "<laneSection s=\"0\"><center>" +
                  lane(0, 0,
                       "<roadMark sOffset=\"0\" type=\"none\">" + lines +
                           "<roadMark sOffset=\"30\" type=\"broken\" width=\"0.3\">" + lines) +
                  "</center><right>" + lane(-1, 3.5) + "</right></laneSection>";
  const RoadNetwork network = read_or_fail(road.xml());
  CHECK(road_mark_at(network, 0, 0, 10.0)->lines.empty());
  REQUIRE(road_mark_at(network, 0, 0, 40.0)->lines.size() == 1);
  CHECK(road_mark_at(network, 0, 0, 40.0)->lines[0].width_m == 0.3);
}

TEST_CASE("crossfall and lateral shape lower and raise the surface") {
  SmallRoad road;
  road.profiles =
      "<lateralProfile><crossfall side=\"right\" s=\"0\" a=\"0.02\" b=\"0\" c=\"0\" d=\"0\"/>"
      "<shape s=\"0\" t=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/><shape s=\"100\" t=\"0\" a=\"0\" "
      "b=\"0.1\" c=\"0\" d=\"0\"/>"
      "</lateralProfile>";
  const RoadNetwork network = read_or_fail(road.xml());
  CHECK(evaluate(network, {0, 0.0, -3.0}).position_m.z == doctest::Approx(-3.0 * std::tan(0.02)));
  CHECK(evaluate(network, {0, 50.0, 2.0}).position_m.z == doctest::Approx(0.1));
}

}  // namespace septet::road
