#pragma once
/// The command that a choice on the operator's page is, as a person would type it.

#include <filesystem>
#include <string>
#include <vector>

#include "command-line/command/operate_command.hpp"
#include "sim-server/page/drive_choice.hpp"

namespace septet::server {

/// What a choice is on the command line: the program's name and its arguments.
std::vector<std::string> command_of(const page::DriveChoice& choice, const OperateOptions& options,
                                    const std::filesystem::path& folder);
/// The same of an experiment's next drive, whose arguments `septet drive` takes.
std::vector<std::string> command_of_experiment(const std::vector<std::string>& drive, const page::DriveChoice& choice,
                                               const OperateOptions& options);
/// The same as a person types it.
std::string typed(const std::vector<std::string>& command);

}  // namespace septet::server
