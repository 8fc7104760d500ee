#pragma once
/// `septet replay --verify SESSION`: the recorded input, run again, must give the recorded state hash at every tick.

#include <filesystem>

namespace septet::server {

int run_verify(const std::filesystem::path& session);

}  // namespace septet::server
