#pragma once
/// Compatibility of an experiment's folder with its changed file.

#include <string>

#include "command-line/command/experiment_study.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// The folder's finished drives must be in this experiment's plan: same drives, in the same words. Error: the drive
/// that would now differ.
Expected<void> check_same_drives(const Study& study, const std::string& earlier_text);

}  // namespace septet::server
