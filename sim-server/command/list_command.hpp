#pragma once
/// `septet list`: what there is to choose from, a line each.

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

/// scenarios, lessons, rigs, vehicles, drivers, experiments.
const std::vector<std::string>& listed_kinds();

struct ListEntry {
  std::string name;  ///< As the command line takes it: a name of those that Septet came with, or a file of one's own.
  std::string description;
  std::string title;                                            ///< Of a lesson or an experiment; else empty.
  std::vector<std::pair<std::string, std::string>> parameters;  ///< Of a scenario: name and its own value.
  bool is_lesson = false, is_game = false;                      ///< Of a scenario.
  bool is_own = false;                                          ///< It lies in a folder of one's own.
};
/// What Septet came with, then what lies in these folders (`own_folders`). A file of these that cannot be read says so in its description.
Expected<std::vector<ListEntry>> list_of(const std::string& kind,
                                         const std::vector<std::filesystem::path>& own_folders = {});

/// What an entry is, in one line. A description that begins with the title says it once.
std::string title_and_description(const ListEntry& entry);

/// Names with the description that their file begins with, to standard output. `data` are folders of one's own beside the one that one
/// stands in.
Expected<int> run_list(const std::string& kind, const std::vector<std::filesystem::path>& data);

}  // namespace septet::server
