#include "logging/session/session_editor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <utility>

#include <fmt/core.h>

#include "logging/session/record_tables.hpp"
#include "logging/session/session_reader.hpp"
#include "logging/session/sqlite_database.hpp"
#include "logging/session/subject.hpp"

namespace septet::logging {
namespace {

/// Quotes a text for SQL.
std::string quoted(const std::string& text) {
  std::string sql = "'";
  for (const char c : text) sql += c == '\'' ? std::string("''") : std::string(1, c);
  return sql + '\'';
}

/// Opens a session for changes, the newest commits of a killed drive folded in. Error: not a session, or its writer has
/// not ended.
Expected<Database> open_closed(const std::filesystem::path& session) {
  bool has_ended = false;
  {
    // The reader goes first: it refuses files that are no session, or were altered.
    const auto reader = SessionReader::open(session);
    if (!reader) return tl::unexpected(reader.error());
    has_ended = reader->ended_cleanly();
  }
  std::error_code ignored;
  const bool has_wal = std::filesystem::exists(session.string() + "-wal", ignored);
  auto database = Database::open(session, OpenMode::change);
  // Succeeds only if no other program has the file open; a session that has ended may be open in a reader.
  if (database && has_wal && !database->execute("PRAGMA journal_mode=DELETE") && !has_ended)
    return failure("the drive is still going on", session.string(), "wait for its end");
  return database;
}

Expected<void> strip(const Database& database, const SessionInfo& info) {
  auto done = database.execute("PRAGMA secure_delete=ON; BEGIN");
  if (done) done = insert_meta(database, "participant", "");
  for (const auto& [key, value] : info.other)
    if (done && is_personal(key)) done = database.execute("DELETE FROM meta WHERE key = " + quoted(key));
  if (done) done = database.execute("UPDATE questionnaire SET reason = ''");
  // Texts of an operator may name the driver: notes, words to the driver, the reason of the end.
  for (const auto& [kind, words] : {std::pair("mark", " note="), {"word", " text="}, {"operator", " reason="}})
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

Expected<void> check_has_ended(const std::filesystem::path& session) {
  if (const auto database = open_closed(session); !database) return tl::unexpected(database.error());
  return {};
}

Expected<void> add_answers(const std::filesystem::path& session, const std::vector<QuestionnaireRecord>& answers,
                           const std::string& replace) {
  const auto database = open_closed(session);
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
  {
    const auto database = open_closed(session);
    if (!database) return tl::unexpected(database.error());
    // One file without side files, and no program has it open: otherwise the replacement would be read with the old
    // side files.
    if (auto joined = database->execute("PRAGMA journal_mode=DELETE"); !joined) return tl::unexpected(joined.error());
  }
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
    const auto copy = Database::open(draft, OpenMode::change);
    if (!copy) return failed(copy.error());
    if (auto done = strip(*copy, info); !done) return failed(done.error());
  }
  if (!is_synchronised(draft)) return failed({"the disk does not take it", draft.string(), "check the disk"});
  return draft;
}

}  // namespace septet::logging
