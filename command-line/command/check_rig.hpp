#pragma once
/// A rig file with all files that it names, checked before anyone drives it.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/road/opendrive_reader.hpp"

namespace septet::server {

/// `text`: of `file`, beside which its DBC file lies. Reads the rig, its vehicle, DBC file, report layout and simulated
/// driver; opens no device.
std::vector<road::Finding> check_rig(const std::string& text, const std::filesystem::path& file);

}  // namespace septet::server
