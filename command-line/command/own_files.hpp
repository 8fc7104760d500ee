#pragma once
/// A user's own files: rigs, vehicles, scenarios with their lessons, experiments, in folders of their own.
///
/// A folder is searched itself, and its subfolders `rigs`, `vehicles`, `scenarios` and `scenarios/experiments` (or
/// `experiments`), so that a copy of Septet's own tree of data will do. The keys of a TOML file tell its kind.

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// A found file and its name on the command line.
struct OwnFile {
  std::string name;
  std::filesystem::path file;
};

/// The working folder, then the given ones, each once; without that of Septet's own data. Error: a given path is no
/// folder.
Expected<std::vector<std::filesystem::path>> own_folders(const std::vector<std::filesystem::path>& given);

/// Files of a kind ("rigs", "vehicles", "scenarios", "experiments"), in the order of the folders and by name in each,
/// each file once. In a folder of thousands of files only the first most_own_files by name are considered.
std::vector<OwnFile> own_files(const std::string& kind, const std::vector<std::filesystem::path>& folders);
inline constexpr std::size_t most_own_files = 500;

}  // namespace septet::server
