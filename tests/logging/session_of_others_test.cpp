// Effects of a foreign session on its reader: none.

#include <fcntl.h>
#include <sqlite3.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <bit>
#include <csignal>
#include <cstdint>
#include <fstream>
#include <iterator>

#include <doctest/doctest.h>

#include "logging/session/files_beside.hpp"
#include "logging/session/recorded_scene.hpp"
#include "logging/session/session_editor.hpp"
#include "tests/logging/session_fixture.hpp"
#include "tests/watched_folder.hpp"

namespace septet::logging {
namespace {
namespace fs = std::filesystem;

constexpr std::string_view journal_magic("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);

fs::path write_drive(const fs::path& path, Tick ticks = 20) {
  SessionWriter writer = must_create(path);
  for (Tick tick = 0; tick < ticks; ++tick) writer.record(taken(drive_snapshot(tick)));
  REQUIRE(writer.finish().has_value());
  return path;
}

std::string bytes_in(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void put(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

void execute(const fs::path& path, const std::string& sql) {
  sqlite3* database = nullptr;
  REQUIRE(sqlite3_open(path.c_str(), &database) == SQLITE_OK);
  char* why = nullptr;
  CHECK_MESSAGE(sqlite3_exec(database, sql.c_str(), nullptr, nullptr, &why) == SQLITE_OK, (why ? why : ""));
  sqlite3_free(why);
  sqlite3_close(database);
}

std::string big_endian(std::uint32_t value) {
  return {static_cast<char>(value >> 24), static_cast<char>(value >> 16), static_cast<char>(value >> 8),
          static_cast<char>(value)};
}

/// A journal with nothing to roll back that names a file to be deleted.
std::string super_journal(const fs::path& session, const std::string& victim) {
  const auto pages = static_cast<std::uint32_t>(fs::file_size(session) / 16384);
  std::string bytes(journal_magic);
  bytes += big_endian(0) + big_endian(0x1234) + big_endian(pages) + big_endian(512) + big_endian(16384);
  bytes.resize(512);
  std::uint32_t sum = 0;
  for (const char c : victim) sum += static_cast<std::uint32_t>(static_cast<signed char>(c));
  return bytes + big_endian(0x40000000 / 16384 + 1) + victim + big_endian(static_cast<std::uint32_t>(victim.size())) +
         big_endian(sum) + std::string(journal_magic);
}

/// Runs something in a process that ends at once, as a killed one does.
template <class Work>
void run_and_kill(Work work) {
  const pid_t child = ::fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    work();
    ::kill(::getpid(), SIGKILL);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
}

/// A change cut off after its pages had reached the file: the journal beside it holds the old pages.
void cut_off_an_answer(const fs::path& session) {
  run_and_kill([&] {
    sqlite3* database = nullptr;
    sqlite3_open(session.c_str(), &database);
    sqlite3_exec(database,
                 "PRAGMA cache_size=1; PRAGMA cache_spill=1; BEGIN IMMEDIATE; UPDATE meta SET value = 'half done' "
                 "WHERE key = 'weather'; DELETE FROM snapshots",
                 nullptr, nullptr, nullptr);
    // Pages go to the file before the commit where the cache is too small for them.
    sqlite3_db_cacheflush(database);
  });
  REQUIRE(fs::file_size(session.string() + "-journal") > 512);
}

/// Reads everything in a session; returns the message of a failure.
std::string read_all(const fs::path& session) {
  const auto reader = SessionReader::open(session);
  if (!reader) return describe(reader.error());
  for (const auto& done : {reader->check_integrity(), reader->inputs().map([](const auto&) {}),
                           reader->samples().map([](const auto&) {}), reader->events().map([](const auto&) {})})
    if (!done) return describe(done.error());
  auto cursor = reader->snapshots();
  if (!cursor) return describe(cursor.error());
  for (int count = 0;; ++count) {
    const auto snapshot = cursor->next();
    if (!snapshot) return describe(snapshot.error());
    if (!*snapshot) return std::to_string(count) + " snapshots, weather " + reader->info().other.at("weather");
  }
}

}  // namespace

TEST_CASE("a journal that names another file deletes nothing, and the session is refused by the journal's name") {
  const TemporaryFolder folder;
  const fs::path own = folder / "own", sent = folder / "sent";
  fs::create_directory(own);
  fs::create_directory(sent);
  const fs::path session = write_drive(sent / "session.sqlite");
  // By path, by a name in the current folder, by a name that no file has, and one whose sum is wrong.
  for (const std::string& victim : {(own / "thesis.txt").string(), std::string("thesis.txt"), (own / "absent").string(),
                                    (sent / "session.sqlite-journal").string()}) {
    put(own / "thesis.txt", "years of work");
    put(session.string() + "-journal", super_journal(session, victim));
    const WatchedFolder watched_own(own), watched_sent(sent);
    const auto reader = SessionReader::open(session);
    REQUIRE_FALSE(reader.has_value());
    CHECK(reader.error().where == session.string() + "-journal");
    CHECK_FALSE(add_answers(session, {}).has_value());
    CHECK_FALSE(write_anonymous_copy(session).has_value());
    CHECK(watched_own.changes() == "");
    CHECK(watched_sent.changes() == "");
  }
}

TEST_CASE("a journal that names another file is refused by a link to the session, too") {
  const TemporaryFolder folder;
  fs::create_directory(folder / "sent");
  const fs::path session = write_drive(folder / "sent" / "session.sqlite");
  put(folder / "thesis.txt", "years of work");
  put(session.string() + "-journal", super_journal(session, (folder / "thesis.txt").string()));
  fs::create_symlink(session, folder / "link.sqlite");
  CHECK_FALSE(SessionReader::open(folder / "link.sqlite").has_value());
  CHECK(fs::exists(folder / "thesis.txt"));
}

TEST_CASE("what lies beside a session and is no file is refused and not waited for") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  for (const char* ending : {"-journal", "-wal", "-shm"}) {
    const fs::path beside = session.string() + ending;
    REQUIRE(::mkfifo(beside.c_str(), 0600) == 0);
    CHECK_FALSE(SessionReader::open(session).has_value());
    fs::remove(beside);
    fs::create_symlink(folder / "elsewhere", beside);
    CHECK_FALSE(SessionReader::open(session).has_value());
    CHECK_FALSE(fs::exists(folder / "elsewhere"));
    fs::remove(beside);
  }
  CHECK(SessionReader::open(session).has_value());
}

TEST_CASE("an answer that was cut off is rolled back for who reads, in a copy, and for good by the next answer") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  cut_off_an_answer(session);
  const WatchedFolder watched(folder.path());
  CHECK(read_all(session) == "20 snapshots, weather clear");
  CHECK(watched.changes() == "");
  const QuestionnaireRecord answer{"paper.fun", "It was fun", "4", 4.0, 12.0, false, ""};
  REQUIRE(add_answers(session, {answer}, "paper.").has_value());
  CHECK_FALSE(fs::exists(session.string() + "-journal"));
  CHECK(read_all(session) == "20 snapshots, weather clear");
}

TEST_CASE("a killed drive is read with its newest commits, with and without the index beside it, and nothing changes") {
  const TemporaryFolder folder;
  const fs::path session = folder / "session.sqlite";
  run_and_kill([&] {
    auto writer = SessionWriter::create(session, example_info(), {});
    for (Tick tick = 0; tick < 20; ++tick) writer->record(taken(drive_snapshot(tick)));
    while (writer->committed_tick() != Tick{19}) ::usleep(1000);
    ::kill(::getpid(), SIGKILL);  // Before the writer closes it.
  });
  REQUIRE(fs::file_size(session.string() + "-wal") > 0);
  {
    const WatchedFolder watched(folder.path());
    CHECK(read_all(session) == "20 snapshots, weather clear");
    CHECK(watched.changes() == "");
  }
  put(session.string() + "-shm", std::string(32768, '\x5a'));  // An index that says nonsense.
  CHECK(read_all(session) == "20 snapshots, weather clear");
  fs::remove(session.string() + "-shm");
  {
    const WatchedFolder watched(folder.path());
    CHECK(read_all(session) == "20 snapshots, weather clear");
    CHECK(watched.changes() == "");
  }
  // A folder without write permission can still be read.
  REQUIRE(add_answers(session, {}).has_value());
  CHECK_FALSE(fs::exists(session.string() + "-wal"));
  CHECK(read_all(session) == "20 snapshots, weather clear");
}

TEST_CASE("a drive that goes on is read up to its newest commit, and ends as if nobody had looked") {
  const TemporaryFolder folder;
  const fs::path session = folder / "session.sqlite";
  SessionWriter writer = must_create(session);
  for (Tick tick = 0; tick < 20; ++tick) writer.record(taken(drive_snapshot(tick)));
  while (writer.committed_tick() != Tick{19}) ::usleep(1000);
  CHECK(read_all(session) == "20 snapshots, weather clear");
  REQUIRE(writer.finish().has_value());
  CHECK_FALSE(fs::exists(session.string() + "-wal"));
  CHECK(read_all(session) == "20 snapshots, weather clear");
}

TEST_CASE("the newest commits that somebody laid beside a closed session are read in a copy") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  put(session.string() + "-wal", std::string(40'000, 'x'));
  const WatchedFolder watched(folder.path());
  CHECK(read_all(session) == "20 snapshots, weather clear");
  CHECK(watched.changes() == "");
}

TEST_CASE("a session with a trigger, or with a view or a foreign table in the place of one of its own, is refused") {
  const TemporaryFolder folder;
  const fs::path good = write_drive(folder / "good.sqlite");
  const std::pair<const char*, const char*> altered[] = {
      {"on answers", "CREATE TRIGGER t AFTER INSERT ON questionnaire BEGIN DELETE FROM snapshots; END"},
      {"on the subject", "CREATE TRIGGER t BEFORE UPDATE ON meta BEGIN DELETE FROM meta; END"},
      {"a view",
       "DROP TABLE actuators; CREATE VIEW actuators AS WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x+1 "
       "FROM c) SELECT x AS tick, 1.0 a, 1.0 b, 1.0 c, 1.0 d, 0 e FROM c"},
      {"a view in capitals", "DROP TABLE head_positions; CREATE VIEW Head_Positions AS SELECT 1 AS tick"},
      {"generated", "DROP TABLE actuators; CREATE TABLE actuators(tick INTEGER PRIMARY KEY, fan REAL AS (abs(tick)))"},
      {"a virtual table", "DROP TABLE saved_states; CREATE VIRTUAL TABLE saved_states USING fts5(tick, data)"}};
  for (const auto& [name, sql] : altered) {
    const fs::path session = folder / "altered.sqlite";
    fs::copy_file(good, session, fs::copy_options::overwrite_existing);
    execute(session, sql);
    const std::string before = bytes_in(session), kind(name);
    CHECK_FALSE_MESSAGE(SessionReader::open(session).has_value(), kind);
    CHECK_FALSE_MESSAGE(add_answers(session, {}).has_value(), kind);
    CHECK_FALSE_MESSAGE(write_anonymous_copy(session).has_value(), kind);
    CHECK_MESSAGE(bytes_in(session) == before, kind);
  }
}

TEST_CASE(
    "a text is UTF-8 without overlong forms, surrogates, cut characters or any beyond the last plane, or refused") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  const auto is_accepted = [&](const std::string& hexadecimal) {
    execute(session, "UPDATE meta SET value = CAST(x'" + hexadecimal + "' AS TEXT) WHERE key = 'weather'");
    return must_open(session).check_values().has_value();
  };
  for (const char* good : {"7a", "c3a9", "e282ac", "ed9fbf", "f09f9a97", "f48fbfbf"})
    CHECK_MESSAGE(is_accepted(good), good);
  for (const char* bad :
       {"80", "ff80", "c080", "c1bf", "e080af", "eda080", "f4908080", "f5808080", "c3", "e282", "f09f9a", "c37a"})
    CHECK_FALSE_MESSAGE(is_accepted(bad), bad);
}

TEST_CASE(
    "changes beside a session that are larger than any drive's are refused at once, and what is no WAL is passed "
    "over") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  const fs::path wal = folder / "session.sqlite-wal";
  put(wal, std::string("\x37\x7f\x06\x83", 4));
  fs::resize_file(wal, most_copied_bytes + 1);  // Holes: it takes no room here.
  CHECK(read_all(session).find("MB of changes that belong to it") != std::string::npos);
  put(wal, "no WAL");
  fs::resize_file(wal, most_copied_bytes + 1);
  CHECK(read_all(session) == "20 snapshots, weather clear");
}

TEST_CASE("a session whose statistics make SQLite sort is read without a file beside it") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  execute(session, "ANALYZE; UPDATE sqlite_stat1 SET stat = '-1 -1 x'");
  const WatchedFolder watched(folder.path());
  const std::string said = read_all(session);
  CHECK_MESSAGE(said == "20 snapshots, weather clear", said);
  CHECK(watched.changes() == "");
}

TEST_CASE("functions in an index that somebody made are not run by who reads") {
  const TemporaryFolder folder;
  const fs::path session = write_drive(folder / "session.sqlite");
  execute(session, "CREATE INDEX i ON snapshots(hex(zeroblob(1000000)))");
  const WatchedFolder watched(folder.path());
  const std::string said = read_all(session);
  CHECK_MESSAGE((said.find("not authorized") != std::string::npos || said == "20 snapshots, weather clear"), said);
  CHECK(watched.changes() == "");
}

}  // namespace septet::logging
