#pragma once
/// Questionnaires that are answered on the operator's page after a drive: the same rows as those of `septet session answer`.
///
/// The page says what a browser has said; it is judged here. The scale of each minute (MISC) is not among them: its answers are given
/// during the drive, and would be replaced.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/questionnaire.hpp"
#include "sim-server/page/messages.hpp"

namespace septet::server {

/// Those that are installed, by name.
Expected<std::vector<logging::Questionnaire>> find_questionnaires();
/// How the page shows them.
std::vector<page::QuestionnaireChoice> choices_of(const std::vector<logging::Questionnaire>& questionnaires);

/// Writes the answers into the session's file, in place of earlier ones of that name, and renews summary and report beside it. Nothing where it was done, else why not: another
/// questionnaire, item or value, a name that is no plain word, a drive that goes on.
std::optional<std::string> keep_answers(const std::vector<logging::Questionnaire>& questionnaires,
                                        const page::Answer& answer, const std::filesystem::path& session);

}  // namespace septet::server
