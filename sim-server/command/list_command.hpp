#pragma once
/// `septet list`: what there is to choose from, a line each.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// scenarios, rigs, vehicles, drivers.
const std::vector<std::string>& listed_kinds();

/// Names with the description that their file begins with, to standard output.
Expected<int> run_list(const std::string& kind);

}  // namespace septet::server
