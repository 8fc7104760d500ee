#pragma once
/// `septet film`: the film is made by `septet-film`, which lies beside this program and takes its place.

#include <string>
#include <vector>

namespace septet::server {

/// Does not return but where that program cannot be started.
int run_film(std::vector<std::string> arguments);

}  // namespace septet::server
