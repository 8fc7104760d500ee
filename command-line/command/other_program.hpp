#pragma once
/// `septet film` and `septet ice`: drawing is done by a program of its own, which lies beside this one and replaces it.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Returns only if that program cannot be started.
Expected<int> become(const std::string& name, std::vector<std::string> arguments);

}  // namespace septet::server
