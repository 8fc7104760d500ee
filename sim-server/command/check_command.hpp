#pragma once
/// `septet check FILE…`: everything that is wrong with road, scenario and rig files, one line each.

#include <string>
#include <vector>

namespace septet::server {

/// Answers 1 if any file has an error; warnings alone do not count.
int run_check(const std::vector<std::string>& files);

}  // namespace septet::server
