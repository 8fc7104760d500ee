#pragma once
/// Changes to a session that is closed: answers that came after the drive, and a person who is to be forgotten.
///
/// Each call succeeds as a whole or changes nothing, also where the program is killed or the disk is full.

#include <filesystem>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/records.hpp"

namespace septet::logging {

/// Rows for the table `questionnaire`. Where `replace` is not empty, rows of items that begin with it go first.
/// Error: the drive is still going on, or the file cannot be changed.
Expected<void> add_answers(const std::filesystem::path& session, const std::vector<QuestionnaireRecord>& answers,
                           const std::string& replace = {});

/// A copy beside the session, PATH.part, in which nothing tells who drove: no participant, note or own column, and no reason in
/// their words. Group, condition and everything measured stay. Nothing of what went is left in the copy's free pages.
Expected<std::filesystem::path> write_anonymous_copy(const std::filesystem::path& session);

}  // namespace septet::logging
