#pragma once
/// Questionnaires answered on the operator's page after a drive: the same rows as those of `septet session answer`.
///
/// The browser's input arrives unchecked; it is checked here. The scale of each minute (MISC) is excluded: its answers
/// are given during the drive, and would be replaced.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/study/questionnaire.hpp"
#include "sim-server/page/messages.hpp"

namespace septet::server {

/// Installed questionnaires, by name.
Expected<std::vector<logging::Questionnaire>> find_questionnaires();
/// Questionnaires in the page's form.
std::vector<page::QuestionnaireChoice> choices_of(const std::vector<logging::Questionnaire>& questionnaires);

/// Writes the answers into the session's file, in place of earlier ones of that name, and renews summary and report
/// beside it. Empty on success, else the reason: another questionnaire, item or value, a name that is no plain word, a
/// running drive.
std::optional<std::string> keep_answers(const std::vector<logging::Questionnaire>& questionnaires,
                                        const page::Answer& answer, const std::filesystem::path& session);

}  // namespace septet::server
