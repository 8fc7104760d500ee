#include "logging/session_editor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include <fmt/core.h>

#include "logging/record_tables.hpp"
#include "logging/session_reader.hpp"
#include "logging/sqlite_database.hpp"
#include "logging/subject.hpp"

namespace septet::logging {
namespace {

/// As a text of SQL.
std::string quoted(const std::string& text) {
  std::string sql = "'";
  for (const char c : text) sql += c == '\'' ? std::string("''") : std::string(1, c);
  return sql + '\'';
}

/// Error: whoever writes it has not ended.
Expected<void> check_closed(const std::filesystem::path& session) {
  {
    const auto reader = SessionReader::open(session);
    if (!reader) return tl::unexpected(reader.error());
    if (reader->ended_cleanly()) return {};  // A side file that is there all the same is for somebody who reads it.
  }
  // Of a killed writer's side files nothing is left by now.
  std::error_code ignored;
  if (std::filesystem::exists(session.string() + "-wal", ignored))
    return failure("the drive is still going on", session.string(), "wait for its end");
  return {};
}

/// Everything in one file, which nobody has open: what is put in its place would be read with its side files otherwise.
Expected<void> join_side_files(const std::filesystem::path& session) {
  const auto database = Database::open(session, OpenMode::read);
  if (!database) return tl::unexpected(database.error());
  return database->execute("PRAGMA journal_mode=DELETE");
}

Expected<void> strip(const Database& database, const SessionInfo& info) {
  auto done = database.execute("PRAGMA secure_delete=ON; BEGIN");
  if (done) done = insert_meta(database, "participant", "");
  for (const auto& [key, value] : info.other)
    if (done && is_personal(key)) done = database.execute("DELETE FROM meta WHERE key = " + quoted(key));
  if (done) done = database.execute("UPDATE questionnaire SET reason = ''");
  // What an operator wrote, of the drive's end or of a moment, may be about them.
  for (const auto& [kind, words] : {std::pair("mark", " note="), {"operator", " reason="}})
    if (done)
      done =
          database.execute(fmt::format("UPDATE events SET detail = substr(detail, 1, instr(detail, '{0}') - 1) WHERE "
                                       "kind = '{1}' AND instr(detail, '{0}') > 0",
                                       words, kind));
  if (done) done = database.execute("COMMIT");
  if (done) done = database.execute("PRAGMA journal_mode=DELETE; VACUUM");
  return done;
}

/// Until it is on the disk, a renamed file may be empty after a power cut.
bool is_synchronised(const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return false;
  const bool done = ::fsync(file) == 0;
  ::close(file);
  return done;
}

}  // namespace

Expected<void> add_answers(const std::filesystem::path& session, const std::vector<QuestionnaireRecord>& answers,
                           const std::string& replace) {
  if (auto closed = check_closed(session); !closed) return closed;
  const auto database = Database::open(session, OpenMode::read);
  if (!database) return tl::unexpected(database.error());
  auto done = database->execute("BEGIN IMMEDIATE");
  if (!done) return done;
  if (!replace.empty())
    done = database->execute(
        fmt::format("DELETE FROM questionnaire WHERE substr(item, 1, {}) = {}", replace.size(), quoted(replace)));
  auto statement = prepare_answer_insert(*database);
  if (!statement) return tl::unexpected(statement.error());
  for (const QuestionnaireRecord& answer : answers)
    if (done) done = insert(*statement, answer);
  if (done) done = database->execute("COMMIT");
  if (!done && database->in_transaction()) (void)database->execute("ROLLBACK");
  return done;
}

Expected<std::filesystem::path> write_anonymous_copy(const std::filesystem::path& session) {
  if (auto closed = check_closed(session); !closed) return tl::unexpected(closed.error());
  if (auto joined = join_side_files(session); !joined) return tl::unexpected(joined.error());
  const std::filesystem::path draft = session.string() + ".part";
  std::error_code error;
  std::filesystem::remove(draft, error);
  const auto failed = [&](const Error& reason) -> Expected<std::filesystem::path> {
    std::filesystem::remove(draft, error);
    return tl::unexpected(reason);
  };
  SessionInfo info;
  {
    const auto reader = SessionReader::open(session);
    if (!reader) return tl::unexpected(reader.error());
    info = reader->info();
  }
  std::filesystem::copy_file(session, draft, error);
  if (error)
    return failed({error.message(), draft.string(), "free some space, or make the folder one that can be written"});
  {
    const auto copy = Database::open(draft, OpenMode::read);
    if (!copy) return failed(copy.error());
    if (auto done = strip(*copy, info); !done) return failed(done.error());
  }
  if (!is_synchronised(draft)) return failed({"the disk does not take it", draft.string(), "check the disk"});
  return draft;
}

}  // namespace septet::logging
