#pragma once
/// `septet replay --verify SESSION`: the recorded input, run again, must give the recorded state hash at every tick.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

Expected<int> run_verify(const std::filesystem::path& session);

}  // namespace septet::server
