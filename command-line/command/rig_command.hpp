#pragma once
/// `septet rig`: preparation of a rig of several machines.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct RigKeysOptions {
  std::string rig;
  std::filesystem::path out = "keys";
  std::vector<std::string> editors;  ///< Each "NAME" or "NAME=RIGHTS".
};

/// Writes the keys of a rig's machines and editors below `out` (sim-server/host/rig_keys.hpp) and prints the new ones.
Expected<int> run_rig_keys(const RigKeysOptions& options);

}  // namespace septet::server
