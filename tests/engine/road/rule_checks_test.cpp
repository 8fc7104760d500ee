// For every checker rule of the standard that is checked on roads: a file that follows it and is silent, the same file
// with one fault, and an edition that did not know the rule yet.
#include <set>

#include <doctest/doctest.h>

#include "road_files.hpp"

template <>
struct doctest::StringMaker<std::set<std::string>> {
  static String convert(const std::set<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all += text + "; ";
    return all.c_str();
  }
};

namespace septet::road {
namespace {

/// The rules that are broken, without "asam.net:xodr:"; a finding without a rule is its text.
std::set<std::string> broken(const std::string& xml) {
  std::set<std::string> rules;
  for (const Finding& finding : check_opendrive(xml, "rules.xodr")) {
    CHECK(finding.severity == Severity::warning);
    CHECK(finding.line > 0);
    CHECK_FALSE(finding.error.remedy.empty());
    rules.insert(finding.rule.empty() ? finding.error.what : finding.rule.substr(std::string("asam.net:xodr:").size()));
  }
  return rules;
}

using Rules = std::set<std::string>;

std::string linked_lane(const char* links, const char* width = "a=\"3.5\" b=\"0\"") {
  return std::string("<lane id=\"-1\" type=\"driving\" level=\"false\"><link>") + links +
         "</link><width sOffset=\"0\" " + width + " c=\"0\" d=\"0\"/></lane>";
}

std::string straight(const std::string& id, double x_m, const std::string& junction, const std::string& links,
                     const std::string& lanes) {
  return SmallRoad{
      .length_m = 50.0, .sections = lane_section("", lanes), .id = id, .junction = junction, .link = links, .x_m = x_m}
      .text();
}

constexpr const char *before = "<predecessor id=\"-1\"/>", *after = "<successor id=\"-1\"/>",
                     *both = "<predecessor id=\"-1\"/><successor id=\"-1\"/>";

/// Two roads, one after the other.
std::string chain() {
  return roads_text(straight("a", 0, "-1", link_to_road("successor", "b", "start"), linked_lane(after)) +
                    straight("b", 50, "-1", link_to_road("predecessor", "a", "end"), linked_lane(before)));
}

/// Two roads and the one that connects them in a junction.
std::string junction() {
  return roads_text(straight("a", 0, "-1", link_to_junction("successor", "7"), linked_lane("")) +
                    straight("c", 50, "7",
                             link_to_road("predecessor", "a", "end") + link_to_road("successor", "b", "start"),
                             linked_lane(both)) +
                    straight("b", 100, "-1", link_to_junction("predecessor", "7"), linked_lane("")) +
                    "<junction id=\"7\">" + connection("0", "a", "c") + "</junction>");
}

std::string edition(const std::string& xml, const char* minor) {
  return replaced(xml, "revMinor=\"8\"", std::string("revMinor=\"") + minor + "\"");
}

std::string cubic_road(const std::string& coefficients) {
  return SmallRoad{.geometry = "<paramPoly3 " + coefficients + "/>"}.xml();
}

}  // namespace

TEST_CASE("roads that follow the rules are silent") {
  CHECK(broken(chain()) == Rules{});
  CHECK(broken(junction()) == Rules{});
  CHECK(broken(motorway_text()) == Rules{});
}

TEST_CASE("lanes that go on are linked both ways, have a width there and join") {
  CHECK(broken(replaced(chain(), before, "")) == Rules{"1.4.0:road.lane.link.lanes_across_lane_sections"});
  const std::string ends = replaced(chain(), linked_lane(after), linked_lane(after, "a=\"3.5\" b=\"-0.07\""));
  CHECK(broken(ends) == Rules{"1.4.0:road.lane.link.new_lane_appear", "1.7.0:road.lane.link.zero_width_at_end"});
  CHECK(broken(edition(ends, "6")) == Rules{"1.4.0:road.lane.link.new_lane_appear"});
  const std::string begins = replaced(chain(), linked_lane(before), linked_lane(before, "a=\"0\" b=\"0.07\""));
  CHECK(broken(begins) == Rules{"1.4.0:road.lane.link.new_lane_appear", "1.7.0:road.lane.link.zero_width_at_start"});
  const std::string narrow = replaced(chain(), linked_lane(before), linked_lane(before, "a=\"3.4\" b=\"0\""));
  CHECK(broken(narrow) == Rules{"1.7.0:lane_smoothness.contact_point_no_horizontal_gaps"});
  CHECK(broken(edition(narrow, "6")) == Rules{});
  CHECK(broken(replaced(junction(), "x=\"50\" y=\"0\"", "x=\"50\" y=\"0.2\"")) ==
        Rules{"1.7.0:lane_smoothness.contact_point_no_horizontal_gaps"});
}

TEST_CASE("the surface does not step where lanes are linked") {
  const auto raised = [](double height) {
    return replaced(chain(), "</planView>\n\n<lanes>",
                    "</planView><elevationProfile>" + elevation(height) + "</elevationProfile>\n<lanes>");
  };
  CHECK(broken(raised(0.02)) == Rules{});
  CHECK(broken(raised(0.3)) == Rules{"the surface steps by 0.300 m from lane -1 of road a at "
                                     "s=50.000 to lane -1 of road b at s=0.000"});
}

TEST_CASE("outside a level lane and in its continuation lanes are level") {
  const std::string level = replaced(chain(), "level=\"false\"", "level=\"true\"");
  CHECK(broken(level) == Rules{"1.7.0:road.lane.level_true_one_side"});
  CHECK(broken(edition(level, "6")) == Rules{});
  CHECK(broken(replaced(junction(), "level=\"false\"", "level=\"true\"")) ==
        Rules{"1.7.0:road.lane.level_true_one_side"});
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" +
                  replaced(lane(-1, 3.5), "<lane", "<lane level=\"true\"") + lane(-2, 2.0) + "</right></laneSection>";
  CHECK(broken(road.xml()) == Rules{"1.7.0:road.lane.level_true_one_side"});
}

TEST_CASE("a road has one road at each end or a junction") {
  const std::string third = straight("c", 0, "-1", link_to_road("successor", "b", "start"), linked_lane(""));
  CHECK(broken(replaced(chain(), "</OpenDRIVE>", third + "</OpenDRIVE>")) ==
        Rules{"1.4.0:road.linkage.is_junction_needed"});
  CHECK(broken(replaced(SmallRoad{}.xml(), "<planView>",
                        "<link><successor elementType=\"road\" elementId=\"a\" "
                        "contactPoint=\"end\"/></link><planView>")) ==
        Rules{"road a is linked to this very end of itself"});
}

TEST_CASE("connections lead from roads outside into the junction, with the traffic") {
  const std::string good = junction();
  CHECK(broken(replaced(good, "incomingRoad=\"a\" connectingRoad=\"c\" contactPoint=\"start\"",
                        "incomingRoad=\"b\" connectingRoad=\"c\" contactPoint=\"start\"")) ==
        Rules{"1.7.0:junctions.connection.start_along_linkage", "1.8.0:junctions.connection.one_link_to_incoming",
              "1.7.0:lane_smoothness.contact_point_no_horizontal_gaps",
              "who comes to junction 7 by road a has no way out of it"});
  CHECK(broken(replaced(good, "connectingRoad=\"c\" contactPoint=\"start\"",
                        "connectingRoad=\"c\" contactPoint=\"end\"")) ==
        Rules{"1.7.0:junctions.connection.end_opposite_linkage", "1.8.0:junctions.connection.one_link_to_incoming",
              "1.7.0:lane_smoothness.contact_point_no_horizontal_gaps"});
  CHECK(broken(replaced(good, "to=\"-1\"", "to=\"-2\"")) ==
        Rules{"its lane link -1 to -2 names a lane that road c does not have there"});
  const std::string again =
      "<connection id=\"1\" incomingRoad=\"a\" connectingRoad=\"c\" contactPoint=\"start\">"
      "<laneLink from=\"-1\" to=\"-1\"/></connection></junction>";
  const std::string twice = replaced(good, "</junction>", again);
  CHECK(broken(twice) == Rules{});
  CHECK(broken(edition(twice, "7")) == Rules{"1.7.0:junctions.connection.one_connection_element"});
  CHECK(broken(replaced(good, "road id=\"a\" junction=\"-1\"", "road id=\"a\" junction=\"7\"")) ==
        Rules{"1.4.0:junctions.connection.connect_road_no_incoming_road"});
}

TEST_CASE("a junction has connections, and who comes to it has a way out") {
  const std::string good = junction();
  CHECK(broken(replaced(good, connection("0", "a", "c"), "")) ==
        Rules{"junction 7 has no connections: nobody gets through"});
  const std::string arm = straight("d", 200, "-1", link_to_junction("successor", "7"), linked_lane(""));
  CHECK(broken(replaced(good, "<junction id=", arm + "<junction id=")) ==
        Rules{"who comes to junction 7 by road d has no way out of it"});
  // One that leads out alone needs no connection from it.
  const std::string exit = straight("d", 200, "-1", link_to_junction("predecessor", "7"), linked_lane(""));
  CHECK(broken(replaced(good, "<junction id=", exit + "<junction id=")) == Rules{});
}

TEST_CASE("borders do not cross and access is not mixed") {
  const auto border = [](int id, const char* a) {
    return "<lane id=\"" + std::to_string(id) + "\" type=\"driving\"><border sOffset=\"0\" a=\"" + a +
           "\" b=\"0.03\" c=\"0\" d=\"0\"/></lane>";
  };
  const auto with = [&](const std::string& lanes) {
    return SmallRoad{.sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lanes +
                                 "</right></laneSection>"}
        .xml();
  };
  CHECK(broken(with(border(-1, "-4") + border(-2, "-7"))) == Rules{});
  CHECK(broken(with(border(-1, "-7") + border(-2, "-6.9"))) ==
        Rules{"1.4.0:road.lane.border.overlap_with_inner_lanes"});
  CHECK(broken(replaced(with(border(-1, "-4")), "<lanes>",
                        "<lanes><laneOffset s=\"0\" a=\"0\" b=\"0\" c=\"0\" d=\"0\"/>")) ==
        Rules{"1.4.0:road.lanes.lane_offset.no_offset_if_border_defined"});
  const std::string access = "<access sOffset=\"0\" rule=\"allow\" restriction=\"bus\"/>";
  CHECK(broken(with(lane(-1, 3.5, access + access))) == Rules{});
  CHECK(broken(with(lane(-1, 3.5, access + replaced(access, "allow", "deny")))) ==
        Rules{"1.7.0:road.lane.access.no_mix_of_deny_or_allow"});
  CHECK(broken(with(lane(-1, 3.5, access + replaced(replaced(access, "allow", "deny"), "\"0\"", "\"9\"")))) == Rules{});
}

TEST_CASE("parametric curves begin where they say and are as long as they say") {
  const std::string line = "aU=\"0\" bU=\"1\" cU=\"0\" dU=\"0\" aV=\"0\" bV=\"0\" cV=\"0\" dV=\"0\"";
  const std::string by_length = line + " pRange=\"arcLength\"",
                    normalized = replaced(line, "bU=\"1\"", "bU=\"100\"") + " pRange=\"normalized\"";
  CHECK(broken(cubic_road(by_length)) == Rules{});
  CHECK(broken(cubic_road(normalized)) == Rules{});
  const Rules aligned{"1.7.0:road.geometry.paramPoly3.valid_parameters"};
  CHECK(broken(cubic_road(replaced(by_length, "aV=\"0\"", "aV=\"0.5\""))) == aligned);
  CHECK(broken(cubic_road(replaced(replaced(by_length, "bU=\"1\"", "bU=\"0.8\""), "bV=\"0\"", "bV=\"0.6\""))) ==
        aligned);
  CHECK(broken(cubic_road(replaced(by_length, "bU=\"1\"", "bU=\"1.1\""))) ==
        Rules{"1.7.0:road.geometry.parampoly3.arclength_range"});
  CHECK(broken(cubic_road(replaced(normalized, "bU=\"100\"", "bU=\"101\""))) ==
        Rules{"1.7.0:road.geometry.parampoly3.length_match"});
  CHECK(broken(edition(cubic_road(replaced(by_length, "bU=\"1\"", "bU=\"1.1\"")), "6")) == Rules{});
}

TEST_CASE("records that say nothing new are named") {
  const Rules redundant{"1.7.0:performance.avoid_redundant_info"};
  const auto profile = [](const char* second) {
    return SmallRoad{.profiles = std::string("<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0\" "
                                             "c=\"0.001\" d=\"0\"/><elevation s=\"50\" a=\"2.5\" ") +
                                 second + " c=\"0.001\" d=\"0\"/></elevationProfile>"}
        .xml();
  };
  CHECK(broken(profile("b=\"0.1\"")) == redundant);
  CHECK(broken(profile("b=\"0.2\"")) == Rules{});
  CHECK(broken(edition(profile("b=\"0.1\""), "6")) == Rules{});
  const std::string lines = replaced(SmallRoad{}.xml(), "hdg=\"0\" length=\"100\">\n<line/>",
                                     "hdg=\"0\" length=\"50\"><line/></geometry><geometry s=\"50\" x=\"50\" y=\"0\" "
                                     "hdg=\"0\" length=\"50\"><line/>");
  CHECK(broken(lines) == redundant);
}

TEST_CASE("an attribute that the schema requires is missed") {
  const Rules schema{"1.0.0:xml.valid_schema"};
  const std::string good = SmallRoad{}.xml(), bad = replaced(good, " d=\"0\"/>", "/>");
  CHECK(broken(bad) == schema);
  CHECK(broken(edition(bad, "4")) == Rules{});  // The schema of 1.4 requires nothing.
  const auto findings = check_opendrive(bad, "bad.xodr");
  REQUIRE(findings.size() == 1);
  CHECK(findings[0].error.what == "attribute d is missing");
  CHECK(findings[0].error.where == "bad.xodr:9, <width>");
  const std::string sign =
      "<signals><signal id=\"1\" s=\"5\" t=\"1\" zOffset=\"0\" type=\"274\" "
      "subtype=\"1\" dynamic=\"no\" orientation=\"+\"/></signals></road>";
  CHECK(broken(replaced(good, "</road>", sign)) == Rules{});
  CHECK(broken(replaced(good, "</road>", replaced(sign, " dynamic=\"no\"", ""))) == schema);
}

}  // namespace septet::road
