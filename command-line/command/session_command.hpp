#pragma once
/// `septet session`: what is added to a session after the drive, and what is taken away.

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
  std::filesystem::path answers;  ///< TOML; empty: they are asked for.
  std::string as;                 ///< What the items are called by; empty: the questionnaire's id.
};
/// Answers from a file, or asked on `out` and read from `in`, a line each; an empty line leaves the item unanswered.
Expected<int> run_session_answer(const AnswerOptions& options, std::istream& in, std::ostream& out);

struct StopOptions {
  std::filesystem::path session;
  std::string reason;
  std::optional<double> at_s;  ///< Simulated; nothing: the session's end.
};
/// The participant has dropped out.
Expected<int> run_session_stop(const StopOptions& options);

struct ForgetOptions {
  std::string participant;
  std::vector<std::filesystem::path> places;  ///< Sessions, and folders with sessions anywhere below.
  bool delete_data = false;
};
/// Takes a participant out of sessions and what lies beside them, or deletes their drives. Where it fails or is
/// killed it can be done again.
Expected<int> run_session_forget(const ForgetOptions& options);

/// The sessions that these paths mean: files as they are, of folders every session.sqlite below, sorted.
Expected<std::vector<std::filesystem::path>> find_sessions(const std::vector<std::filesystem::path>& places);

}  // namespace septet::server
