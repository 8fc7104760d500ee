#pragma once
/// Reads ASAM OpenDRIVE 1.4 to 1.8 into a RoadNetwork.
///
/// The text may come from anywhere: for any content the result is a network or an error, in memory bounded by the
/// text's size. An error makes the file unusable; a warning tells of an ignored or repaired part.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/road/road_network.hpp"

namespace septet::road {

enum class Severity : std::uint8_t { warning, error };

/// One fault of a file; `error.where` is "name:line, <element>".
struct Finding {
  Severity severity = Severity::error;
  int line = 0;
  Error error;
  /// The standard's checker rule behind it, "asam.net:xodr:1.4.0:…"; empty without one.
  std::string rule = {};
};

/// The network, or the first error. `name` is the file's name in messages. Warnings are added to `warnings` if given.
Expected<RoadNetwork> read_opendrive(std::string_view xml, std::string_view name,
                                     std::vector<Finding>* warnings = nullptr);

/// All faults of the text, in the order of its lines, at most 1,000 findings; empty for a clean file. A readable text
/// is also checked against the standard's checker rules (CHECKS.md).
std::vector<Finding> check_opendrive(std::string_view xml, std::string_view name);

}  // namespace septet::road
