#pragma once
/// The command for a choice on the operator's page, as a person would type it.

#include <filesystem>
#include <string>
#include <vector>

#include "command-line/command/operate_command.hpp"
#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

/// Command line of a choice: the program's name and its arguments.
std::vector<std::string> command_of(const page::DriveChoice& choice, const OperateOptions& options,
                                    const std::filesystem::path& folder);
/// Command line of an experiment's next drive, as arguments of `septet drive`.
std::vector<std::string> command_of_experiment(const std::vector<std::string>& drive, const page::DriveChoice& choice,
                                               const OperateOptions& options);
/// The same, quoted for a shell.
std::string typed(const std::vector<std::string>& command);

}  // namespace septet::server
