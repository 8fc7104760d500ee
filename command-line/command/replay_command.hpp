#pragma once
/// `septet replay --verify SESSION [--from SECONDS]`: the recorded input, run again, must give the recorded state hash at every tick,
/// from the last state at or before `from_s` that the log has kept; from the start where there is none.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

Expected<int> run_verify(const std::filesystem::path& session, double from_s);

}  // namespace septet::server
