#pragma once
/// `septet film` and `septet ice`: what draws is a program of its own, which lies beside this one and takes its place.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Returns only where that program cannot be started.
Expected<int> become(const std::string& name, std::vector<std::string> arguments);

}  // namespace septet::server
