#include "sim-server/command/check_command.hpp"

#include <filesystem>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/rig/rig.hpp"
#include "engine/road/opendrive_reader.hpp"
#include "engine/scenario/scenario_reader.hpp"

namespace septet::server {
namespace {

using road::Finding;
using road::Severity;

std::vector<Finding> check_file(const std::filesystem::path& file) {
  const auto text = read_regular_file(file);
  if (!text) return {{Severity::error, 0, text.error()}};
  const auto extension = file.extension();
  if (extension == ".xodr") return road::check_opendrive(*text, file.string());
  if (extension == ".xosc") return scenario::check_scenario(*text, file.string(), scenario::files_in(file.parent_path().string()));
  if (extension == ".toml") {
    if (const auto rig = rig::read_rig(*text, file.string()); !rig) return {{Severity::error, 0, rig.error()}};
    return {};
  }
  return {{Severity::error, 0, {"it is neither .xodr, .xosc nor .toml", file.string(), "check roads, scenarios and rigs"}}};
}

}  // namespace

int run_check(const std::vector<std::string>& files) {
  std::size_t errors = 0, warnings = 0;
  for (const auto& file : files)
    for (const auto& finding : check_file(file)) {
      const bool error = finding.severity == Severity::error;
      ++(error ? errors : warnings);
      fmt::print("{}: {}\n", error ? "error" : "warning", describe(finding.error));
    }
  fmt::print("{} files, {} errors, {} warnings\n", files.size(), errors, warnings);
  return errors == 0 ? 0 : 1;
}

}  // namespace septet::server
