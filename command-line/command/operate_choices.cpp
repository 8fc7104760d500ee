#include "command-line/command/operate_choices.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "command-line/command/list_command.hpp"
#include "command-line/command/own_files.hpp"
#include "engine/core/printable.hpp"
#include "logging/session/subject.hpp"
#include "program/resources.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

page::Choice choice_of(const ListEntry& entry) {
  return {printable(entry.name, 400), printable(entry.description, 1000), printable(entry.title, 200), entry.is_own};
}

}  // namespace

Expected<page::Choices> find_choices(const OperateOptions& options) {
  std::vector<fs::path> given = options.data;
  page::Choices choices;
  if (!options.rig.empty()) {
    const auto rig = program::find_resource(options.rig, "rigs", ".toml");
    if (!rig) return tl::unexpected(rig.error());
    choices.first_rig = options.rig;
    if (options.rig.find('/') != std::string::npos) given.push_back(rig->parent_path());
  }
  const auto folders = own_folders(given);
  if (!folders) return tl::unexpected(folders.error());
  const auto take = [&](const std::string& kind, std::vector<page::Choice>& into) -> Expected<void> {
    const auto list = list_of(kind, *folders);
    if (!list) return tl::unexpected(list.error());
    for (const ListEntry& entry : *list) into.push_back(choice_of(entry));
    return {};
  };
  const auto scenarios = list_of("scenarios", *folders);
  if (!scenarios) return tl::unexpected(scenarios.error());
  for (const ListEntry& entry : *scenarios)
    choices.scenarios.push_back({choice_of(entry), entry.parameters, entry.is_lesson, entry.is_game});
  if (auto taken = take("experiments", choices.experiments); !taken) return tl::unexpected(taken.error());
  if (auto taken = take("rigs", choices.rigs); !taken) return tl::unexpected(taken.error());
  if (auto taken = take("drivers", choices.drivers); !taken) return tl::unexpected(taken.error());
  if (auto taken = take("vehicles", choices.vehicles); !taken) return tl::unexpected(taken.error());
  // A given rig can always be chosen, in any spelling.
  const bool is_listed = std::ranges::any_of(choices.rigs, [&](const page::Choice& rig) {
    std::error_code error;
    return rig.name == choices.first_rig || fs::equivalent(rig.name, choices.first_rig, error);
  });
  if (!choices.first_rig.empty() && !is_listed)
    choices.rigs.push_back({.name = choices.first_rig, .about = "", .title = "", .is_own = true});
  for (const page::Choice& rig : choices.rigs)
    if (std::error_code error; rig.is_own && fs::equivalent(rig.name, choices.first_rig, error))
      choices.first_rig = rig.name;
  return choices;
}

std::optional<std::string> no_choice(const page::Choices& choices, const page::DriveChoice& choice) {
  const auto is_one_of = [](const auto& list, const std::string& name) {
    return std::ranges::any_of(list, [&](const page::Choice& one) { return one.name == name; });
  };
  if (!choice.experiment.empty())
    return is_one_of(choices.experiments, choice.experiment)
               ? std::nullopt
               : std::optional<std::string>("there is no such experiment");
  if (!is_one_of(choices.scenarios, choice.scenario)) return "there is no such scenario";
  if (!choice.rig.empty() && !is_one_of(choices.rigs, choice.rig)) return "there is no such rig";
  if (!choice.driver.empty() && !is_one_of(choices.drivers, choice.driver)) return "there is no such driver";
  if (!choice.vehicle.empty() && !is_one_of(choices.vehicles, choice.vehicle)) return "there is no such vehicle";
  if (!choice.order.empty() && !logging::is_order(choice.order)) return "the order is a whole number from 1 on";
  return std::nullopt;
}

}  // namespace septet::server
