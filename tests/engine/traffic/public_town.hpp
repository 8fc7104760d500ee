#pragma once
/// A public town of the conformance data.

#include <fstream>
#include <iterator>
#include <string>

#include <doctest/doctest.h>

#include "engine/road/opendrive_reader.hpp"
#include "tests/conformance/conformance_data.hpp"

namespace septet::traffic {

inline road::RoadNetwork public_town(const std::string& name) {
  const auto path = conformance_data("towns") / (name + ".xodr");
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  auto network = road::read_opendrive(text, path.string());
  REQUIRE(network.has_value());
  return *network;
}

}  // namespace septet::traffic
