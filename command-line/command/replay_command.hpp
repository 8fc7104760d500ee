#pragma once
/// `septet replay --verify SESSION [--from SECONDS]`: re-simulates the recorded input, which must give the recorded
/// state hash at every tick, from the last logged state at or before `from_s`; from the start if there is none.

#include <filesystem>

#include "engine/core/expected.hpp"

namespace septet::server {

Expected<int> run_verify(const std::filesystem::path& session, double from_s);

}  // namespace septet::server
