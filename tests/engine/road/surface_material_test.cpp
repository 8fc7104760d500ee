#include "engine/road/surface_material.hpp"

#include <algorithm>

#include <doctest/doctest.h>

#include "road_files.hpp"

namespace septet::road {
namespace {

/// A dry left lane, a right lane that turns to snow at 40 m, and two patches of ice.
std::string mixed_road() {
  SmallRoad road;
  road.sections = "<laneSection s=\"0\"><left>" + lane(1, 3.0) + "</left><center>" + lane(0, 0) + "</center><right>" +
                  lane(-1, 3.5,
                       "<material sOffset=\"0\" friction=\"0.8\" roughness=\"2\"/>"
                       "<material sOffset=\"40\" surface=\"snow\" friction=\"0.3\"/>") +
                  "</right></laneSection>";
  std::string xml = road.xml();
  const auto at = xml.find("</road>");
  return xml.insert(at,
                    "<objects>"
                    "<object id=\"1\" type=\"patch\" s=\"20\" t=\"-1.5\" length=\"4\" width=\"1\" hdg=\"0\">"
                    "<material surface=\"ice\" friction=\"0.1\"/></object>"
                    "<object id=\"2\" type=\"patch\" s=\"60\" t=\"1\"><outlines><outline>"
                    "<cornerRoad s=\"58\" t=\"0\" dz=\"0\" height=\"0\"/><cornerRoad s=\"62\" t=\"0\" dz=\"0\" "
                    "height=\"0\"/>"
                    "<cornerRoad s=\"60\" t=\"2\" dz=\"0\" height=\"0\"/></outline></outlines>"
                    "<material surface=\"ice\"/></object>"
                    "<object id=\"3\" type=\"tree\" s=\"80\" t=\"-1\" length=\"2\" width=\"2\"/></objects>");
}

}  // namespace

TEST_CASE("a place is made of its lane's material from the station where that begins") {
  const RoadNetwork network = read_or_fail(mixed_road());
  const auto at = [&](double s, double t) { return material_at(network, {0, s, t}); };
  CHECK(at(10.0, 1.0) == nullptr);
  REQUIRE(at(10.0, -1.0) != nullptr);
  CHECK(at(10.0, -1.0)->friction == doctest::Approx(0.8));
  CHECK(at(10.0, -1.0)->roughness == doctest::Approx(2.0));
  CHECK(at(41.0, -1.0)->surface == "snow");
}

TEST_CASE("a patch lies on the lane within its outline and nowhere else") {
  const RoadNetwork network = read_or_fail(mixed_road());
  const auto is_ice = [&](double s, double t) {
    const SurfaceMaterial* material = material_at(network, {0, s, t});
    return material && material->surface == "ice";
  };
  CHECK(is_ice(20.0, -1.5));
  CHECK(is_ice(21.9, -1.1));
  CHECK_FALSE(is_ice(22.1, -1.5));
  CHECK_FALSE(is_ice(20.0, -0.9));
  CHECK(is_ice(60.0, 1.9));
  CHECK_FALSE(is_ice(58.5, 1.0));   // Beside the triangle.
  CHECK_FALSE(is_ice(80.0, -1.0));  // A tree is no patch.
}

TEST_CASE("a friction below 0 is said and none is given") {
  std::string xml = mixed_road();
  const auto at = xml.find("friction=\"0.8\"");
  xml.replace(at, 14, "friction=\"-1\"");
  const auto findings = check_opendrive(xml, "broken.xodr");
  CHECK(std::ranges::any_of(findings, [](const Finding& finding) {
    return finding.error.what == "friction=-1 is below 0; it is taken as 0";
  }));
}

}  // namespace septet::road
