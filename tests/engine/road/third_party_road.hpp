#pragma once
/// A road of the conformance data.

#include <fstream>
#include <iterator>
#include <string>

#include "tests/conformance/conformance_data.hpp"
#include "tests/engine/road/road_files.hpp"

namespace septet::road {

inline RoadNetwork third_party_road(const std::string& name) {
  std::ifstream file(conformance_data("roads") / (name + ".xodr"));
  return read_or_fail({std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()});
}

}  // namespace septet::road
