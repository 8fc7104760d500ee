#pragma once
/// Questionnaires of an experiment that are still due.

#include <filesystem>
#include <string>
#include <vector>

#include "command-line/command/experiment_study.hpp"

namespace septet::server {

/// Answers that a subject owes.
struct MissingAnswers {
  std::string questionnaire;      ///< Its name in the experiment.
  std::string condition;          ///< The condition after which it is due; empty: after the last drive.
  std::filesystem::path session;  ///< The session for them.
};
std::vector<MissingAnswers> missing_answers(const Study& study, const logging::PlannedSubject& subject,
                                            const Stand& stand);

}  // namespace septet::server
