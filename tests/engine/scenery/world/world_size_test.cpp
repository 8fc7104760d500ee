// Networks that are well-formed and too large to be surrounded by a world.
#include "engine/scenery/world/road_world.hpp"

#include <doctest/doctest.h>

#include "tests/engine/road/road_files.hpp"

namespace septet::scenery {
namespace {

using road::lane;
using road::read_or_fail;
using road::replaced;
using road::SmallRoad;

std::string refusal(const std::string& xml) {
  const auto checked = check_world_size(read_or_fail(xml));
  REQUIRE_FALSE(checked.has_value());
  return checked.error().what;
}

}  // namespace

TEST_CASE("the motorway's world can be built") {
  CHECK(check_world_size(road::motorway()).has_value());
  CHECK(check_world_size(read_or_fail(SmallRoad{}.xml())).has_value());
}

TEST_CASE("a network with more land, lanes, dashes, structures or signals than a region is refused") {
  CHECK(refusal(SmallRoad{.length_m = 1e6}.xml()) == "the land around it is larger than 6291 km²");

  std::string lanes;
  for (int i = 1; i <= 60; ++i) lanes += lane(-i, 3.5);
  SmallRoad wide{
      .length_m = 5e5,
      .sections = "<laneSection s=\"0\"><center>" + lane(0, 0) + "</center><right>" + lanes + "</right></laneSection>"};
  CHECK(refusal(wide.xml()) == "its lanes are 30500 km long, more than 20000 km");

  SmallRoad dashed{.length_m = 1e5};
  dashed.sections = "<laneSection s=\"0\"><center>" +
                    lane(0, 0,
                         "<roadMark sOffset=\"0\" type=\"broken\"><type name=\"x\"><line "
                         "length=\"0.05\" space=\"0.05\"/></type></roadMark>") +
                    "</center><right>" + lane(-1, 3.5) + "</right></laneSection>";
  CHECK(refusal(dashed.xml()) == "its lines have 1000000 dashes, more than 500000");

  std::string tunnels;
  for (int i = 0; i < 2001; ++i) tunnels += "<tunnel id=\"1\" s=\"1\" length=\"2\"/>";
  CHECK(refusal(replaced(SmallRoad{}.xml(), "</road>", "<objects>" + tunnels + "</objects></road>")) ==
        "it has 2001 bridges and tunnels, more than 2000");

  std::string signals;
  for (int i = 0; i < 20001; ++i) signals += "<signal id=\"1\" type=\"206\" s=\"1\" t=\"-5\"/>";
  CHECK(refusal(replaced(SmallRoad{}.xml(), "</lanes>", "</lanes><signals>" + signals + "</signals>")) ==
        "it has 20001 signals, more than 20000");
}

}  // namespace septet::scenery
