#pragma once
/// Reads ASAM OpenDRIVE 1.4 to 1.8 into a RoadNetwork.
///
/// The text may come from anywhere: whatever it holds, the answer is a network or an error, in
/// memory bounded by the text's size. An error stops the file from being used; a warning says what
/// was ignored or repaired.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/road/road_network.hpp"

namespace septet::road {

enum class Severity : std::uint8_t { warning, error };

/// One thing wrong with a file; `error.where` is "name:line, <element>".
struct Finding {
  Severity severity = Severity::error;
  int line = 0;
  Error error;
  /// The checker rule of the standard that says so, "asam.net:xodr:1.4.0:…"; empty where none does.
  std::string rule = {};
};

/// The network, or the first error. `name` is the file's name in messages. Warnings are added to
/// `warnings` if given.
Expected<RoadNetwork> read_opendrive(std::string_view xml, std::string_view name,
                                     std::vector<Finding>* warnings = nullptr);

/// Everything wrong with the text, in the order of its lines, at most 1,000 findings; empty for a
/// clean file. Where the text can be read, the standard's checker rules are held against it too
/// (CHECKS.md).
std::vector<Finding> check_opendrive(std::string_view xml, std::string_view name);

}  // namespace septet::road
