#pragma once
/// Whether an experiment's folder goes on after its file was changed.

#include <string>

#include "command-line/command/experiment_study.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// What has come of the folder's earlier experiment is what this one's plan says, too: same drives, in the same words. Error: which drive
/// would be another one now.
Expected<void> check_same_drives(const Study& study, const std::string& earlier_text);

}  // namespace septet::server
