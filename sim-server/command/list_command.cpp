#include "sim-server/command/list_command.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/core.h>

#include "car-io/simulated_driver/driver_parameters.hpp"
#include "engine/core/regular_file.hpp"
#include "engine/scenario/scenario_reader.hpp"
#include "program/resources.hpp"

namespace septet::server {
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

}  // namespace

const std::vector<std::string>& listed_kinds() {
  static const std::vector<std::string> kinds{"scenarios", "rigs", "vehicles", "drivers"};
  return kinds;
}

Expected<std::vector<ListEntry>> list_of(const std::string& kind) {
  std::vector<ListEntry> entries;
  if (kind == "drivers") {
    for (const auto& driver : car_io::simulated_drivers())
      entries.push_back({.name = std::string(driver.name), .description = std::string(driver.description)});
    return entries;
  }
  const bool scenarios = kind == "scenarios";
  const auto data = program::data_folder();
  if (!data) return tl::unexpected(data.error());
  std::set<std::string> names;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(*data / kind, ignored))
    names.insert(entry.path().stem().string());
  for (const auto& name : names) {
    const auto file = program::find_resource(name, kind, scenarios ? ".xosc" : ".toml");
    if (!file) continue;  // Something else that lies there.
    const auto text = read_regular_file(*file);
    if (!text) return tl::unexpected(text.error());
    ListEntry entry{.name = name};
    if (!scenarios) {
      entry.description = first_comment(*text);
    } else {
      const auto scenario =
          scenario::read_scenario(*text, file->string(), scenario::files_in(file->parent_path().string()));
      entry.description = scenario ? scenario->header.description : "cannot be read: " + describe(scenario.error());
      if (scenario) entry.parameters = scenario->parameters;
    }
    entries.push_back(std::move(entry));
  }
  return entries;
}

Expected<int> run_list(const std::string& kind) {
  const auto entries = list_of(kind);
  if (!entries) return tl::unexpected(entries.error());
  std::size_t width = 0;
  for (const auto& entry : *entries) width = std::max(width, entry.name.size());
  for (const auto& entry : *entries) fmt::print("{:<{}}  {}\n", entry.name, width, entry.description);
  return 0;
}

}  // namespace septet::server
