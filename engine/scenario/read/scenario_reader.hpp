#pragma once
/// Reads ASAM OpenSCENARIO XML 1.0 to 1.3 into a Scenario.
///
/// For any text the result is a scenario or an error. A fault makes the file unusable; an element or attribute that the
/// reader does not support yet is a warning with its name and line and has no effect.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/expected.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/model/scenario.hpp"

namespace septet::scenario {

using road::Finding;
using road::Severity;

/// Access to the catalogs beside a scenario; paths are relative to the scenario's folder.
struct ScenarioFiles {
  std::function<Expected<std::string>(const std::string& path)> read;
  /// The .xosc files of a folder, sorted.
  std::function<Expected<std::vector<std::string>>(const std::string& folder)> list;
};

/// Files of this folder of the disk.
ScenarioFiles files_in(const std::string& folder);

/// A value for a parameter of the scenario that takes the place of the file's own.
struct ParameterValue {
  std::string name, value;
};
/// Parses "NAME=VALUE".
Expected<ParameterValue> parse_parameter(std::string_view text);

/// The scenario, or the first error. `name` is the file's name in messages. Warnings are added to `warnings` if given.
/// A parameter that the file does not declare, or a value of another type or against its constraints, is an error that
/// names the known ones.
Expected<Scenario> read_scenario(std::string_view xml, std::string_view name, const ScenarioFiles& files,
                                 std::vector<Finding>* warnings = nullptr,
                                 const std::vector<ParameterValue>& parameters = {});

/// All faults of the text and all unsupported parts, in the order of its lines; empty for a clean file. Besides
/// scenarios it knows catalogs and ParameterValueDistributions.
std::vector<Finding> check_scenario(std::string_view xml, std::string_view name, const ScenarioFiles& files);

}  // namespace septet::scenario
