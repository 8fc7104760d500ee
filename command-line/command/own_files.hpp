#pragma once
/// What a person has made and where it lies: rigs, vehicles, scenarios with their lessons, experiments, in folders of one's own.
///
/// A folder is looked at as it is, and in its subfolders `rigs`, `vehicles`, `scenarios` and `scenarios/experiments` (or `experiments`), so
/// that a copy of Septet's own tree of data will do. What a TOML file describes is told by its keys.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// What was found: how the command line calls it, and its file.
struct OwnFile {
  std::string name;
  std::filesystem::path file;
};

/// The folder that one stands in, then those given, each once; not the one of the data that Septet came with. Error: one that is given is no
/// folder.
Expected<std::vector<std::filesystem::path>> own_folders(const std::vector<std::filesystem::path>& given);

/// Those of a kind ("rigs", "vehicles", "scenarios", "experiments"), in the order of the folders and by name in each, each file once. Of a
/// folder with thousands of files only the first most_own_files by name are looked at.
std::vector<OwnFile> own_files(const std::string& kind, const std::vector<std::filesystem::path>& folders);
inline constexpr std::size_t most_own_files = 500;

}  // namespace septet::server
