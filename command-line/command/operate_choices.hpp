#pragma once
/// Choices of the operator's page, and the check of a browser's choice against them.

#include <optional>
#include <string>

#include "command-line/command/operate_command.hpp"
#include "engine/core/expected.hpp"
#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

/// Septet's own, and the files in the working folder, in the given ones and beside the given rig. Error: a folder or
/// the rig does not exist, or Septet's own data do not.
Expected<page::Choices> find_choices(const OperateOptions& options);

/// Reason to refuse a choice that is not in the lists, which a browser may request nevertheless. The command line
/// checks the rest.
std::optional<std::string> no_choice(const page::Choices& choices, const page::DriveChoice& choice);

}  // namespace septet::server
