#pragma once
/// Roads for the tests: the motorway of the tree, and small files written on the spot (road_text.hpp), read.

#include <string>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/engine/road/road_text.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::road {

inline std::string motorway_text() { return shipped_text("scenarios/motorway-ambulance/motorway.xodr"); }

inline RoadNetwork read_or_fail(const std::string& xml) {
  const auto network = read_opendrive(xml, "test.xodr");
  const std::string what = why_not(network);
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

}  // namespace septet::road
