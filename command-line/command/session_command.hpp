#pragma once
/// `septet session`: additions to a session after the drive, and removals.

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/expected.hpp"

namespace septet::server {

struct AnswerOptions {
  std::filesystem::path session;
  std::string questionnaire;      ///< A file, or a name below scenarios/questionnaires.
  std::filesystem::path answers;  ///< TOML; empty: asked for on the terminal.
  std::string as;                 ///< Prefix of the items; empty: the questionnaire's id.
};
/// Answers from a file, or prompted on `out` and read from `in`, a line each; an empty line leaves the item unanswered.
Expected<int> run_session_answer(const AnswerOptions& options, std::istream& in, std::ostream& out);

struct StopOptions {
  std::filesystem::path session;
  std::string reason;
  std::optional<double> at_s;  ///< Simulated; empty: the session's end.
};
/// Records a drop-out of the participant.
Expected<int> run_session_stop(const StopOptions& options);

struct ForgetOptions {
  std::string participant;
  std::vector<std::filesystem::path> places;  ///< Sessions, and folders with sessions anywhere below.
  bool delete_data = false;
};
/// Removes a participant from sessions and the files beside them, or deletes their drives, with the links among the
/// places that led to them. A session outside the places, to which a link leads, is left and named. After a failure or a
/// kill it can be repeated.
Expected<int> run_session_forget(const ForgetOptions& options);

/// Sessions of these paths: files as given, for folders every session.sqlite below, sorted.
Expected<std::vector<std::filesystem::path>> find_sessions(const std::vector<std::filesystem::path>& places);

}  // namespace septet::server
