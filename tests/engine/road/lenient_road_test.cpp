// Real files: forms that the standard allows are silent, repairable faults are read with a finding.
#include <algorithm>

#include <doctest/doctest.h>
#include <fmt/core.h>

#include "engine/road/lane_geometry.hpp"
#include "engine/road/lane_links.hpp"
#include "road_files.hpp"

namespace septet::road {
namespace {

std::string only_warning(const std::string& xml) {
  const auto findings = check_opendrive(xml, "lenient.xodr");
  CAPTURE(xml);
  for (const Finding& finding : findings) CAPTURE(finding.error.what);
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].severity == Severity::warning);
  CHECK(read_opendrive(xml, "lenient.xodr").has_value());
  return findings[0].error.what;
}

}  // namespace

TEST_CASE("a friction above that of any road is as the file says") {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 3.5, "<material sOffset=\"0\" friction=\"5.5\"/>") + "</right></laneSection>";
  CHECK(check_opendrive(road.xml(), "grip.xodr").empty());
  CHECK(read_or_fail(road.xml()).roads[0].sections[0].lane(-1).materials.at(0).material.friction == 5.5);
}

TEST_CASE("a link to what the file does not have is said and is no link") {
  const std::string xml = SmallRoad{}.xml();
  const auto linked = [&](const std::string& attributes) {
    return replaced(xml, "<planView>", "<link><successor " + attributes + "/></link><planView>");
  };
  const std::string road = linked("elementType=\"road\" elementId=\"9\" contactPoint=\"start\"");
  CHECK(only_warning(road) == "road 9 does not exist; there is no link");
  const RoadNetwork network = read_or_fail(road);
  CHECK(network.roads[0].successor.road == no_index);
  CHECK(network.roads[0].successor.junction == no_index);
  CHECK(continuations(network, 0, 0, -1, true).empty());
  CHECK(only_warning(linked("elementType=\"junction\" elementId=\"9\"")) ==
        "junction 9 does not exist; there is no link");
  CHECK(only_warning(replaced(xml, "junction=\"-1\"", "junction=\"77\"")) ==
        "junction 77 does not exist; the road belongs to none");
  const std::string junction =
      replaced(xml, "</road>",
               "</road><junction id=\"7\"><connection id=\"0\" incomingRoad=\"a\" connectingRoad=\"b\" "
               "contactPoint=\"start\"/></junction>");
  CHECK(only_warning(junction) == "connection 0 names a road that does not exist; it is left out");
  CHECK(read_or_fail(junction).junctions.at(0).connections.empty());
}

TEST_CASE("a junction's priority orders two of its roads, and one that names others is told and left out") {
  const auto with = [&](const char* priority) {
    return replaced(SmallRoad{}.xml(), "</road>",
                    fmt::format("</road><junction id=\"7\"><priority {}/></junction>", priority));
  };
  for (const char* priority : {"high=\"a\" low=\"b\"", "high=\"a\"", "high=\"a\" low=\"a\""}) {
    // The other is that nothing leads through the junction.
    const auto findings = check_opendrive(with(priority), "priority.xodr");
    CHECK(findings.size() == 2);
    CHECK(std::ranges::count(findings, "a priority of junction 7 does not name two roads; it is left out",
                             [](const Finding& finding) { return finding.error.what; }) == 1);
    CHECK(read_or_fail(with(priority)).junctions.at(0).priorities.empty());
  }
}

TEST_CASE("a centre lane needs no type and every other lane does") {
  const std::string xml = SmallRoad{}.xml();
  CHECK(check_opendrive(replaced(xml, "<lane id=\"0\" type=\"driving\">", "<lane id=\"0\">"), "centre.xodr").empty());
  CHECK(only_warning(replaced(xml, "<lane id=\"1\" type=\"driving\">", "<lane id=\"1\">")) == "lane 1 has no type");
}

TEST_CASE("a revision that is not given is called so") {
  const std::string xml = SmallRoad{}.xml();
  CHECK(only_warning(replaced(xml, " revMinor=\"8\"", "")) ==
        "revMinor is missing or no number; the file is read as OpenDRIVE 1.8");
  CHECK(only_warning(replaced(xml, "revMajor=\"1\"", "revMajor=\"one\"")) ==
        "revMajor is missing or no number; the file is read as OpenDRIVE 1.8");
  CHECK(only_warning(replaced(xml, "revMinor=\"8\"", "revMinor=\"3\"")) == "OpenDRIVE 1.3 is read as 1.8");
}

TEST_CASE("a road ends where its geometry ends") {
  const std::string xml =
      replaced(SmallRoad{}.xml(), "junction=\"-1\" length=\"100\"", "junction=\"-1\" length=\"400\"");
  CHECK(only_warning(xml) == "length=400 but its geometry ends at 100.000 m, where the road is taken to end");
  const RoadNetwork network = read_or_fail(xml);
  CHECK(network.roads[0].length_m == 100.0);
  CHECK(network.roads[0].sections.back().s_end_m == 100.0);
}

TEST_CASE("a lane that begins with width 0 runs off along its slope from the start") {
  const std::string xml = replaced(SmallRoad{}.xml(), "a=\"3.5\" b=\"0\"", "a=\"0\" b=\"0.1\"");
  const RoadNetwork network = read_or_fail(xml);
  const Road& road = network.roads[0];
  for (const double s : {0.0, 1e-6, 10.0}) {
    const LaneBorders borders = lane_borders(road, road.sections[0], -1, s);
    CHECK(borders.outer_t_m == doctest::Approx(-0.1 * s));
    CHECK(borders.outer_slope == doctest::Approx(-0.1));
    CHECK(borders.inner_slope == 0.0);
  }
}

}  // namespace septet::road
