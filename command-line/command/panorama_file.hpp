#pragma once
/// panorama.png: the pictures of all screens at their last common tick, unrolled by angle.

#include <filesystem>
#include <string>

#include "engine/core/expected.hpp"
#include "engine/rig/rig.hpp"

namespace septet::server {

/// Reads OUT/screens/NAME/TICK.png of every screen and writes OUT/panorama.png. Error: the screens have no tick in
/// common.
Expected<void> write_panorama(const std::filesystem::path& out, const rig::Rig& rig, const std::string& title);

}  // namespace septet::server
