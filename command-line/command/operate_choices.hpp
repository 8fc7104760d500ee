#pragma once
/// What the operator's page offers, and whether a browser has chosen one of that.

#include <optional>
#include <string>

#include "command-line/command/operate_command.hpp"
#include "engine/core/expected.hpp"
#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

/// What Septet came with, what lies in the folder that one stands in, in those that are given and in that of the rig that is given. Error: a
/// folder or the rig is not there, or Septet's own data are not.
Expected<page::Choices> find_choices(const OperateOptions& options);

/// What is no choice of the lists, which a browser may ask for all the same. Everything else the command line judges.
std::optional<std::string> no_choice(const page::Choices& choices, const page::DriveChoice& choice);

}  // namespace septet::server
