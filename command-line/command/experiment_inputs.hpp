#pragma once
/// Inputs of an experiment's drives, read before the first drive: rig, every part's scenario under every condition with
/// its road and lesson, drivers, questionnaires. Faults would otherwise be met hours later, and by people.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/study/experiment/design.hpp"

namespace septet::server {

/// A questionnaire that an experiment requires.
struct DueQuestionnaire {
  std::string name;  ///< Its name in the experiment: a file, or an installed one.
  std::string id;    ///< Its own id: the prefix of its answers.
  bool is_after_each_condition = false;
};

/// Error: the first unusable file, at its own place.
Expected<std::vector<DueQuestionnaire>> read_inputs(const logging::Experiment& experiment);

/// A part's parameters under a condition, NAME=VALUE: the condition's value wins, since conditions are compared.
std::vector<std::string> parameters_of(const logging::ExperimentPart& part,
                                       const logging::ExperimentCondition& condition);

}  // namespace septet::server
