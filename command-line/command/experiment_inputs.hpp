#pragma once
/// What an experiment's drives are made from, read before anybody drives: rig, every part's scenario under every condition with its road
/// and lesson, drivers, questionnaires. What is wrong there would otherwise be met hours later, and by people.

#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/experiment/design.hpp"

namespace septet::server {

/// A questionnaire that an experiment asks for.
struct DueQuestionnaire {
  std::string name;  ///< As the experiment calls it: a file, or one that is installed.
  std::string id;    ///< Its own: what its answers are called by.
  bool is_after_each_condition = false;
};

/// Error: the first of the files that cannot be used, at its own place.
Expected<std::vector<DueQuestionnaire>> read_inputs(const logging::Experiment& experiment);

/// A part's parameters under a condition, NAME=VALUE: what both say is the condition's, for that is what is compared.
std::vector<std::string> parameters_of(const logging::ExperimentPart& part,
                                       const logging::ExperimentCondition& condition);

}  // namespace septet::server
