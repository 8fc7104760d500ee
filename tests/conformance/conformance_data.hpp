#pragma once
/// Place of the third-party files and their reference results: tests/conformance/data, or the folder that
/// SEPTET_CONFORMANCE_DIR names. Absent data fails the test that asks for it, so that no green run has checked nothing.

#include <cstdlib>
#include <filesystem>
#include <string>

#include <doctest/doctest.h>

#include "tests/checkout.hpp"

namespace septet {

/// Folder of a set: "roads", "scenarios" or "vehicle".
inline std::filesystem::path conformance_data(const std::string& set) {
  const char* elsewhere = std::getenv("SEPTET_CONFORMANCE_DIR");
  const std::filesystem::path folder =
      (elsewhere != nullptr ? std::filesystem::path(elsewhere)
                            : std::filesystem::path(source_folder()) / "tests/conformance/data") /
      set;
  REQUIRE_MESSAGE(std::filesystem::is_directory(folder), "no conformance data in " << folder.string());
  return folder;
}

}  // namespace septet
