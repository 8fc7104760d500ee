#pragma once
/// Roads for the tests: the motorway of the tree, and small files written on the spot.

#include <sstream>
#include <string>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/shipped_files.hpp"

namespace septet::road {

inline std::string motorway_text() { return shipped_text("scenarios/motorway-ambulance/motorway.xodr"); }

inline RoadNetwork read_or_fail(const std::string& xml) {
  const auto network = read_opendrive(xml, "test.xodr");
  const std::string what = network ? std::string() : describe(network.error());
  REQUIRE_MESSAGE(network.has_value(), what);
  return *network;
}

inline const RoadNetwork& motorway() {
  static const RoadNetwork network = read_or_fail(motorway_text());
  return network;
}

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

/// A lane with a constant width.
inline std::string lane(int id, double width_m, const std::string& inside = "", const std::string& type = "driving") {
  std::ostringstream text;
  text << "<lane id=\"" << id << "\" type=\"" << type << "\">" << inside;
  if (id != 0) text << "<width sOffset=\"0\" a=\"" << width_m << "\" b=\"0\" c=\"0\" d=\"0\"/>";
  text << "</lane>";
  return text.str();
}

/// A file of one road with the given geometry, profiles and lanes.
struct SmallRoad {
  double length_m = 100.0;
  std::string attributes = {}, header = {}, geometry = {}, profiles = {}, before_sections = {}, sections = {};

  std::string xml() const {
    std::ostringstream text;
    text << "<OpenDRIVE>\n<header revMajor=\"1\" revMinor=\"8\">" << header
         << "</header>\n<road id=\"a\" junction=\"-1\" length=\"" << length_m << "\" " << attributes
         << ">\n<planView><geometry s=\"0\" x=\"0\" y=\"0\" hdg=\"0\" length=\"" << length_m << "\">\n"
         << (geometry.empty() ? "<line/>" : geometry) << "\n</geometry></planView>\n"
         << profiles << "\n<lanes>" << before_sections << "\n"
         << (sections.empty() ? "<laneSection s=\"0\"><left>" + lane(1, 3.0) + "</left><center>" + lane(0, 0) +
                                    "</center><right>" + lane(-1, 3.5) + "</right></laneSection>"
                              : sections)
         << "\n</lanes>\n</road>\n</OpenDRIVE>\n";
    return text.str();
  }
};

}  // namespace septet::road
