#include "command-line/command/list_command.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include <fmt/core.h>

#include "command-line/command/own_files.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "logging/study/experiment/design.hpp"
#include "logging/study/lesson/lesson.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

/// The first sentence of the comment that a TOML file begins with.
std::string first_comment(const std::string& text) {
  std::string comment;
  for (std::size_t begin = 0, end; begin < text.size() && text[begin] == '#'; begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    comment += (comment.empty() ? "" : " ") + text.substr(std::min(begin + 2, end), end - std::min(begin + 2, end));
  }
  for (std::size_t stop = comment.find(". "); stop != std::string::npos; stop = comment.find(". ", stop + 1))
    if (stop > 0 && comment[stop - 1] != '.') return comment.substr(0, stop + 1);
  return comment;
}

/// The rules of a scenario as a lesson, which lie beside it; an Error where they are wrong.
std::optional<Expected<logging::Lesson>> lesson_of(const fs::path& scenario) {
  const fs::path file = fs::path(scenario).replace_extension(".lesson.toml");
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return std::nullopt;
  const auto text = read_regular_file(file);
  if (!text) return tl::unexpected(text.error());
  return logging::read_lesson(*text, file.string());
}

void describe_scenario(ListEntry& entry, const fs::path& file, const std::string& text) {
  const auto scenario = scenario::read_scenario(text, file.string(), scenario::files_in(file.parent_path().string()));
  entry.description = scenario ? scenario->header.description : "cannot be read: " + describe(scenario.error());
  if (scenario) {
    entry.parameters = scenario->parameters;
    entry.is_game = scenario->game.has_value();
  }
  const auto lesson = lesson_of(file);
  if (!lesson) return;
  entry.is_lesson = lesson->has_value();
  if (entry.is_lesson)
    entry.title = (*lesson)->title;
  else
    entry.description += "; its lesson cannot be read: " + describe(lesson->error());
}

/// Description of a user's file, or its fault: one bad file does not hide the others.
ListEntry described(std::string name, const std::string& kind, const fs::path& file) {
  ListEntry entry{.name = std::move(name)};
  const auto text = read_regular_file(file);
  if (!text) {
    entry.description = "cannot be read: " + describe(text.error());
  } else if (kind == "scenarios") {
    describe_scenario(entry, file, *text);
  } else {
    entry.description = first_comment(*text);
    if (kind != "experiments") return entry;
    const auto experiment = logging::read_experiment(*text, file.string());
    if (experiment)
      entry.title = experiment->title;
    else
      entry.description = "cannot be read: " + describe(experiment.error());
  }
  return entry;
}

}  // namespace

const std::vector<std::string>& listed_kinds() {
  static const std::vector<std::string> kinds{"scenarios", "lessons", "rigs", "vehicles", "drivers", "experiments"};
  return kinds;
}

Expected<std::vector<ListEntry>> list_of(const std::string& kind, const std::vector<fs::path>& own_folders) {
  std::vector<ListEntry> entries;
  if (kind == "drivers") {
    for (const auto& driver : driver::simulated_drivers())
      entries.push_back({.name = std::string(driver.name), .description = std::string(driver.description)});
    return entries;
  }
  if (kind == "lessons") {
    auto scenarios = list_of("scenarios", own_folders);
    if (scenarios) std::erase_if(*scenarios, [](const ListEntry& entry) { return !entry.is_lesson; });
    return scenarios;
  }
  const auto data = program::data_folder();
  if (!data) return tl::unexpected(data.error());
  const std::string place = kind == "experiments" ? "scenarios/experiments" : kind;
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(*data / place, ignored)) names.insert(entry.path().stem().string());
  for (const auto& name : names) {
    const auto file = program::find_resource(name, place, kind == "scenarios" ? ".xosc" : ".toml");
    if (!file) continue;  // Not a file of this kind.
    entries.push_back(described(name, kind, *file));
  }
  for (auto& [name, file] : own_files(kind, own_folders)) {
    entries.push_back(described(std::move(name), kind, file));
    entries.back().is_own = true;
  }
  return entries;
}

std::string title_and_description(const ListEntry& entry) {
  const std::string &title = entry.title, &description = entry.description;
  if (title.empty() || description == title || description.starts_with(fmt::format("{}: ", title))) return description;
  return description.empty() ? title : fmt::format("{}: {}", title, description);
}

Expected<int> run_list(const std::string& kind, const std::vector<fs::path>& data) {
  const auto folders = own_folders(data);
  if (!folders) return tl::unexpected(folders.error());
  const auto entries = list_of(kind, *folders);
  if (!entries) return tl::unexpected(entries.error());
  std::size_t width = 0;
  for (const auto& entry : *entries) width = std::max(width, entry.name.size());
  for (const auto& entry : *entries) fmt::print("{:<{}}  {}\n", entry.name, width, title_and_description(entry));
  return 0;
}

}  // namespace septet::server
