#pragma once
/// The next drive of an experiment, for whoever starts it: what `septet experiment next` says in words.

#include <string>
#include <vector>

#include "command-line/command/experiment_command.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// The arguments of `septet drive`, "--NAME", "VALUE", and "--parameter=NAME=VALUE". With `only` that participant's. Error: the experiment cannot
/// be read, or everybody (or the participant) is finished.
Expected<std::vector<std::string>> next_of_experiment(const ExperimentOptions& options);

}  // namespace septet::server
