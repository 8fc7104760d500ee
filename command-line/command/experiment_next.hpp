#pragma once
/// The next drive of an experiment, as arguments: the counterpart of `septet experiment next`.

#include <string>
#include <vector>

#include "command-line/command/experiment_command.hpp"
#include "engine/core/expected.hpp"

namespace septet::server {

/// The arguments of `septet drive`, "--NAME", "VALUE", and "--parameter=NAME=VALUE". With `only` that participant's.
/// Error: the experiment cannot be read, or all participants (or this one) are finished.
Expected<std::vector<std::string>> next_of_experiment(const ExperimentOptions& options);

}  // namespace septet::server
