#pragma once
/// A shipped scenario on a shipped rig, loaded as for a drive.

#include <string>

#include <doctest/doctest.h>

#include "sim-server/drive/drive_loader.hpp"
#include "tests/checkout.hpp"
#include "tests/why_not.hpp"

namespace septet::server {

inline LoadedDrive shipped_drive(const std::string& scenario, const std::string& rig, std::uint64_t seed = 1) {
  const std::string root = source_folder();
  auto drive = load_drive(
      DriveFiles{root + "/scenarios/" + scenario + "/" + scenario + ".xosc", root + "/rigs/" + rig + ".toml", seed});
  REQUIRE_MESSAGE(drive.has_value(), why_not(drive));
  return std::move(*drive);
}

}  // namespace septet::server
