#pragma once
/// `septet list`: what there is to choose from, a line each.

#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// scenarios, rigs, vehicles, drivers.
const std::vector<std::string>& listed_kinds();

struct ListEntry {
  std::string name, description;
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Of a scenario: name and its own value.
};
Expected<std::vector<ListEntry>> list_of(const std::string& kind);

/// Names with the description that their file begins with, to standard output.
Expected<int> run_list(const std::string& kind);

}  // namespace septet::server
