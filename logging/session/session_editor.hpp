#pragma once
/// Changes to a closed session: answers given after the drive, and the removal of a person's data.
///
/// Each call succeeds as a whole or changes nothing, also if the program is killed or the disk is full.

#include <filesystem>
#include <vector>

#include "engine/core/expected.hpp"
#include "logging/session/records.hpp"

namespace septet::logging {

/// Error: not a session, or its drive is still going on.
Expected<void> check_has_ended(const std::filesystem::path& session);

/// Rows for the table `questionnaire`. Unless `replace` is empty, rows whose item begins with it are removed first.
/// Error: the drive is still running, or the file cannot be changed.
Expected<void> add_answers(const std::filesystem::path& session, const std::vector<QuestionnaireRecord>& answers,
                           const std::string& replace = {});

/// Writes a copy beside the session, PATH.part, without the driver's identity: no participant, note or own column, and
/// no reason in their words. Group, condition and everything measured stay. The copy's free pages hold no remains of
/// the removed data.
Expected<std::filesystem::path> write_anonymous_copy(const std::filesystem::path& session);

}  // namespace septet::logging
