#pragma once
/// A street of 200 m along x with a pavement of 2.5 m, 0.12 m high, on either side of two lanes of 3.5 m, and a crosswalk
/// in its middle.

#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "engine/traffic/people/walkways.hpp"
#include "tests/why_not.hpp"

namespace septet::traffic {

inline constexpr double street_m = 200.0, crosswalk_s_m = 100.0, kerb_t_m = 3.5, street_pavement_m = 2.5;

inline std::string street_text(bool has_crosswalk = true) {
  std::string lanes;
  for (const int side : {1, -1}) {
    lanes += side > 0 ? "<left>" : "<right>";
    for (const int n : {2, 1}) {
      const std::string id = std::to_string(side > 0 ? n : -(3 - n));
      const bool walked = id == "2" || id == "-2";
      lanes += "<lane id=\"" + id + "\" type=\"" + (walked ? "sidewalk" : "driving") + "\"><width sOffset=\"0\" a=\"" +
               (walked ? "2.5" : "3.5") + "\" b=\"0\" c=\"0\" d=\"0\"/>" +
               (walked ? "<height sOffset=\"0\" inner=\"0.12\" outer=\"0.12\"/>" : "") + "</lane>";
    }
    lanes += side > 0 ? "</left><center><lane id=\"0\" type=\"none\"/></center>" : "</right>";
  }
  const std::string crosswalk =
      "<objects><object id=\"1\" type=\"crosswalk\" s=\"100\" t=\"0\" zOffset=\"0\" orientation=\"none\" length=\"4\" "
      "width=\"7\" height=\"0.01\"/></objects>";
  return "<OpenDRIVE><header revMajor=\"1\" revMinor=\"8\"/><road name=\"\" length=\"200\" id=\"1\" junction=\"-1\">"
         "<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"200\"><line/></geometry></planView>"
         "<lanes><laneSection s=\"0\">" +
         lanes + "</laneSection></lanes>" + (has_crosswalk ? crosswalk : "") + "</road></OpenDRIVE>";
}

inline road::RoadNetwork street(bool has_crosswalk = true) {
  auto network = road::read_opendrive(street_text(has_crosswalk), "street.xodr");
  REQUIRE_MESSAGE(network.has_value(), why_not(network));
  return std::move(*network);
}

}  // namespace septet::traffic
