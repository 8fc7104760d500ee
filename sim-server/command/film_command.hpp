#pragma once
/// `septet film`: the film is made by `septet-film`, which lies beside this program and takes its place.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Returns only where that program cannot be started.
Expected<int> run_film(std::vector<std::string> arguments);

}  // namespace septet::server
