#pragma once
/// `septet rig`: what a rig of several machines needs.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Writes the keys of a rig's machines below `out` (sim-server/host/rig_keys.hpp) and says what is new.
Expected<int> run_rig_keys(const std::string& rig, const std::filesystem::path& out);

}  // namespace septet::server
