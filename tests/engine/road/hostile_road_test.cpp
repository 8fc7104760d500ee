// Files cut off and altered at random: the reader returns a usable network, or errors, and never stops the program. The
// sanitizer builds run this too.
#include <cmath>

#include <doctest/doctest.h>

#include "engine/core/random.hpp"
#include "engine/road/lane_links.hpp"
#include "engine/road/road_locate.hpp"
#include "road_files.hpp"

namespace septet::road {
namespace {

/// A file with every kind of geometry, links and a junction.
std::string rich_text() {
  SmallRoad road{.length_m = 30.0,
                 .geometry =
                     "<paramPoly3 pRange=\"normalized\" aU=\"0\" bU=\"30\" cU=\"0\" dU=\"0\" "
                     "aV=\"0\" bV=\"0\" cV=\"1\" dV=\"-1\"/>"};
  road.profiles =
      "<elevationProfile><elevation s=\"0\" a=\"0\" b=\"0.01\" c=\"0\" "
      "d=\"0\"/></elevationProfile><lateralProfile>"
      "<superelevation s=\"0\" a=\"0.1\" b=\"0\" c=\"0\" d=\"0\"/><shape s=\"0\" t=\"-3\" a=\"0\" "
      "b=\"0\" c=\"0\" d=\"0\"/></lateralProfile>";
  road.before_sections = "<laneOffset s=\"0\" a=\"0.5\" b=\"0\" c=\"0\" d=\"0\"/>";
  const SmallRoad connecting{
      .length_m = 40.0,
      .sections = "<laneSection s=\"0\"><center>" + lane(0, 0, "<roadMark sOffset=\"0\" type=\"broken\"/>") +
                  "</center><right>" + lane(-1, 3.0, "<link><predecessor id=\"-1\"/></link>") +
                  "</right></laneSection>",
      .id = "b",
      .junction = "9",
      .link = link_to_road("predecessor", "a", "end"),
      .plan = plan_piece(0, 30, 0, 0, 20, "<spiral curvStart=\"0\" curvEnd=\"0.02\"/>") +
              plan_piece(20, 50, 1, 0.2, 20, arc(0.02)),
      .after_lanes =
          "<objects><object id=\"1\" s=\"3\" t=\"2\"><repeat s=\"0\" length=\"5\"/></object><tunnel "
          "s=\"1\" length=\"5\" id=\"3\"/></objects>"};
  return roads_text(road.text() + connecting.text() + "<junction id=\"9\">" + connection("0", "a", "b") + "</junction>",
                    road.header);
}

void use(const std::string& xml) {
  const auto network = read_opendrive(xml, "hostile.xodr");
  if (!network) {
    REQUIRE_FALSE(network.error().what.empty());
    REQUIRE_FALSE(network.error().remedy.empty());
    return;
  }
  for (const Finding& finding : check_opendrive(xml, "hostile.xodr")) REQUIRE(finding.severity == Severity::warning);
  for (RoadIndex road = 0; road < network->roads.size(); ++road) {
    const double middle = 0.5 * network->roads[road].length_m;
    const RoadPoint point = evaluate(*network, {road, middle, 1.0});
    locate(*network, Vec2(point.position_m));
    const RoadPosition hint{road, 0.0, 0.0};
    surface_at(*network, Vec2(point.position_m), &hint);
    advance(*network, {road, -1, middle, 0.0}, 100.0);
  }
}

}  // namespace

TEST_CASE("a file cut off anywhere is refused") {
  const std::string text = rich_text();
  use(text);
  for (std::size_t length = 0; length + 13 < text.size(); length += 3) {
    CHECK_FALSE(read_opendrive(text.substr(0, length), "cut.xodr").has_value());
  }
}

TEST_CASE("a file altered anywhere is read or refused and never stops the program") {
  const std::string text = rich_text();
  Random random(7);
  const std::string alphabet = "0123456789.-+e\"<>/ =abs";
  for (int i = 0; i < 3000; ++i) {
    std::string altered = text;
    const auto changes = 1 + random.below(4);
    for (std::uint64_t change = 0; change < changes; ++change) {
      altered[random.below(altered.size())] = alphabet[random.below(alphabet.size())];
    }
    use(altered);
  }
}

TEST_CASE("any number of a file may be replaced by an extreme one") {
  const std::string text = rich_text();
  const char* extremes[] = {"0", "-1", "1e12", "-1e12", "1e-12", "1e308", "nan", "inf", "", "1e6", "0.5", "999999"};
  for (std::size_t at = text.find("=\""); at != std::string::npos; at = text.find("=\"", at + 2)) {
    const std::size_t end = text.find('"', at + 2);
    for (const char* extreme : extremes) use(text.substr(0, at + 2) + extreme + text.substr(end));
  }
}

}  // namespace septet::road
