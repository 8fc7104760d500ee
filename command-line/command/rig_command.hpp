#pragma once
/// `septet rig`: preparation of a rig of several machines.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"

namespace septet::server {

/// Writes the keys of a rig's machines below `out` (sim-server/host/rig_keys.hpp) and prints the new ones.
Expected<int> run_rig_keys(const std::string& rig, const std::filesystem::path& out);

}  // namespace septet::server
