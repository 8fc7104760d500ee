#include "command-line/command/experiment_inputs.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/driver/driver_parameters.hpp"
#include "engine/scenario/read/scenario_reader.hpp"
#include "logging/study/questionnaire.hpp"
#include "program/resources.hpp"
#include "sim-server/drive/drive_loader.hpp"

namespace septet::server {
namespace fs = std::filesystem;
namespace {

Expected<std::vector<scenario::ParameterValue>> read_values(const std::vector<std::string>& parameters) {
  std::vector<scenario::ParameterValue> values;
  for (const auto& text : parameters) {
    auto value = scenario::parse_parameter(text);
    if (!value) return tl::unexpected(value.error());
    values.push_back(std::move(*value));
  }
  return values;
}

/// An error of a scenario with the part and condition that meet it.
tl::unexpected<Error> met_in(Error error, const logging::ExperimentPart& part,
                             const logging::ExperimentCondition& condition) {
  error.what = fmt::format("part {}{}: {}", part.name,
                           condition.name.empty() ? "" : " under condition " + condition.name, error.what);
  return tl::unexpected(std::move(error));
}

/// Checks a scenario with road, rig and lesson once, and for each further condition the scenario under its parameters.
Expected<void> check_part(const logging::ExperimentPart& part, const logging::Experiment& experiment,
                          const fs::path& rig) {
  const auto file = program::find_resource(part.scenario, "scenarios", ".xosc");
  if (!file) return tl::unexpected(file.error());
  std::optional<std::string> road;  // Road of the earlier conditions.
  std::set<std::vector<std::string>> seen;
  for (const auto& condition : experiment.conditions) {
    const auto parameters = parameters_of(part, condition);
    if (!seen.insert(parameters).second) continue;
    auto values = read_values(parameters);
    if (!values) return met_in(values.error(), part, condition);
    if (road) {
      const auto text = read_regular_file(*file);
      if (!text) return met_in(text.error(), part, condition);
      const auto scenario = scenario::read_scenario(*text, file->string(),
                                                    scenario::files_in(file->parent_path().string()), nullptr, *values);
      if (!scenario) return met_in(scenario.error(), part, condition);
      if (scenario->road_file == *road) continue;
    }
    const auto drive = load_drive(
        {.scenario = file->string(), .rig = rig.string(), .seed = experiment.seed, .parameters = std::move(*values)});
    if (!drive) return met_in(drive.error(), part, condition);
    road = drive->model->scenario.road_file;
  }
  return {};
}

Expected<DueQuestionnaire> read_due(const std::string& name, bool is_after_each_condition) {
  const auto file = program::find_resource(name, "scenarios/questionnaires", ".toml");
  if (!file) return tl::unexpected(file.error());
  const auto text = read_regular_file(*file);
  if (!text) return tl::unexpected(text.error());
  const auto questionnaire = logging::read_questionnaire(*text, file->string());
  if (!questionnaire) return tl::unexpected(questionnaire.error());
  return DueQuestionnaire{name, questionnaire->id, is_after_each_condition};
}

}  // namespace

Expected<std::vector<DueQuestionnaire>> read_inputs(const logging::Experiment& experiment) {
  for (const auto& group : experiment.groups)
    if (!group.driver.empty())
      if (const auto driver = driver::find_driver(group.driver); !driver) return tl::unexpected(driver.error());
  std::vector<DueQuestionnaire> due;
  for (const bool after_each : {false, true})
    for (const auto& name : after_each ? experiment.questionnaires_after_each_condition : experiment.questionnaires) {
      auto questionnaire = read_due(name, after_each);
      if (!questionnaire) return tl::unexpected(questionnaire.error());
      due.push_back(std::move(*questionnaire));
    }
  const auto rig = program::find_resource(experiment.rig, "rigs", ".toml");
  if (!rig) return tl::unexpected(rig.error());
  for (const auto& part : experiment.parts)
    if (auto checked = check_part(part, experiment, *rig); !checked) return tl::unexpected(checked.error());
  return due;
}

std::vector<std::string> parameters_of(const logging::ExperimentPart& part,
                                       const logging::ExperimentCondition& condition) {
  const auto is_of_condition = [&](const std::string& parameter) {
    const std::string name = parameter.substr(0, parameter.find('=') + 1);
    return std::ranges::any_of(condition.parameters, [&](const auto& other) { return other.starts_with(name); });
  };
  std::vector<std::string> parameters;
  std::ranges::copy_if(part.parameters, std::back_inserter(parameters),
                       [&](const auto& parameter) { return !is_of_condition(parameter); });
  parameters.insert(parameters.end(), condition.parameters.begin(), condition.parameters.end());
  return parameters;
}

}  // namespace septet::server
