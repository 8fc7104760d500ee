#pragma once
/// Which questionnaires of an experiment are still to be answered.

#include <filesystem>
#include <string>
#include <vector>

#include "command-line/command/experiment_study.hpp"

namespace septet::server {

/// Answers that a subject should have given by now.
struct MissingAnswers {
  std::string questionnaire;      ///< As the experiment calls it.
  std::string condition;          ///< After which it is due; empty: after the last drive.
  std::filesystem::path session;  ///< Where they belong.
};
std::vector<MissingAnswers> missing_answers(const Study& study, const logging::PlannedSubject& subject,
                                            const Stand& stand);

}  // namespace septet::server
