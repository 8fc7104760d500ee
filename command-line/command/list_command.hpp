#pragma once
/// `septet list`: the available names, a line each.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// scenarios, lessons, rigs, vehicles, drivers, experiments.
const std::vector<std::string>& listed_kinds();

struct ListEntry {
  std::string name;  ///< Name for the command line: one of Septet's own, or a file of the user's.
  std::string description;
  std::string title;                                            ///< For a lesson or an experiment; else empty.
  std::vector<std::pair<std::string, std::string>> parameters;  ///< For a scenario: name and default value.
  bool is_lesson = false, is_game = false;                      ///< For a scenario.
  bool is_own = false;                                          ///< A file in a user's folder.
};
/// Septet's own, then the files in these folders (`own_folders`). The description of an unreadable file says so.
Expected<std::vector<ListEntry>> list_of(const std::string& kind,
                                         const std::vector<std::filesystem::path>& own_folders = {});

/// An entry in one line. A description that begins with the title contains it once.
std::string title_and_description(const ListEntry& entry);

/// Prints names with the description at the beginning of their file, to standard output. `data` are user folders beside
/// the working folder.
Expected<int> run_list(const std::string& kind, const std::vector<std::filesystem::path>& data);

}  // namespace septet::server
