#include "command-line/command/own_files.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <system_error>
#include <utility>

#include "engine/core/regular_file.hpp"
#include "engine/document/toml_table.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t largest_toml_bytes = std::size_t{1} << 20;

/// Entries of a folder, by name; empty if it cannot be read.
std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    entries.push_back(at->path());
  std::ranges::sort(entries);
  entries.resize(std::min(entries.size(), most_own_files));
  return entries;
}

/// "rigs", "vehicles", "experiments", by the keys at its top; empty: something else.
std::string_view kind_of_toml(const fs::path& file) {
  if (file.stem().extension() == ".lesson") return "";
  const auto text = read_regular_file(file, largest_toml_bytes);
  if (!text) return "";
  const auto keys = document::top_keys_of_toml(*text, file.string());
  if (!keys) return "";
  const auto has = [&](std::string_view key) { return std::ranges::find(*keys, key) != keys->end(); };
  if (has("screen")) return "rigs";
  if (has("body")) return "vehicles";
  return has("part") && has("group") ? "experiments" : "";
}

bool is_of_kind(const fs::path& file, const std::string& kind) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return false;
  if (kind == "scenarios") return file.extension() == ".xosc";
  return file.extension() == ".toml" && kind_of_toml(file) == kind;
}

/// A folder within one of these, as scenarios have: the file named like the folder, else the only one.
fs::path only_scenario_in(const fs::path& folder) {
  fs::path only;
  for (const fs::path& entry : entries_of(folder)) {
    if (!is_of_kind(entry, "scenarios")) continue;
    if (entry.stem() == folder.filename()) return entry;
    if (!only.empty()) return {};
    only = entry;
  }
  return only;
}

}  // namespace

Expected<std::vector<fs::path>> own_folders(const std::vector<fs::path>& given) {
  std::vector<fs::path> folders;
  std::set<fs::path> known;
  std::error_code error;
  if (const auto data = program::data_folder()) known.insert(fs::weakly_canonical(*data, error));
  const fs::path here = fs::current_path(error);
  if (!error && known.insert(fs::weakly_canonical(here, error)).second) folders.emplace_back(".");
  for (const fs::path& folder : given) {
    if (!fs::is_directory(folder, error))
      return failure("there is no such folder", folder.string(),
                     "give the folder in which rigs, scenarios or experiments of your own lie");
    if (known.insert(fs::weakly_canonical(folder, error)).second) folders.push_back(folder);
  }
  return folders;
}

std::vector<OwnFile> own_files(const std::string& kind, const std::vector<fs::path>& folders) {
  std::vector<OwnFile> found;
  std::set<fs::path> known;
  const auto take = [&](const fs::path& file) {
    std::error_code error;
    if (file.empty() || !known.insert(fs::weakly_canonical(file, error)).second) return;
    found.push_back({file.lexically_normal().string(), file});
  };
  for (const fs::path& folder : folders) {
    std::vector<fs::path> places{folder, folder / (kind == "experiments" ? "scenarios/experiments" : kind)};
    if (kind == "experiments") places.push_back(folder / kind);
    for (const fs::path& place : places)
      for (const fs::path& entry : entries_of(place)) {
        std::error_code error;
        if (is_of_kind(entry, kind))
          take(entry);
        else if (kind == "scenarios" && fs::is_directory(entry, error))
          take(only_scenario_in(entry));
      }
  }
  return found;
}

}  // namespace septet::server
