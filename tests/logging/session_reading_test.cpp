// Readers of a session being written change nothing.

#include <sqlite3.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "logging/session/session_editor.hpp"
#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

using namespace std::chrono_literals;

/// SQLite as any other program uses it, in this one: its locks are those of a connection.
class ForeignReader {
 public:
  explicit ForeignReader(const std::filesystem::path& file, bool may_write = false) {
    const int flags = may_write ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY;
    REQUIRE(sqlite3_open_v2(file.c_str(), &database_, flags, nullptr) == SQLITE_OK);
  }
  ForeignReader(const ForeignReader&) = delete;
  ForeignReader& operator=(const ForeignReader&) = delete;
  ~ForeignReader() { sqlite3_close(database_); }
  int say(const char* sql) { return sqlite3_exec(database_, sql, nullptr, nullptr, nullptr); }

 private:
  sqlite3* database_ = nullptr;
};

/// Another program that repeatedly opens the file, reads and closes it, until it is told to end.
class ComingAndGoing {
 public:
  explicit ComingAndGoing(const std::filesystem::path& file) : child_(fork()) {
    if (child_ != 0) return;
    for (;;) {
      sqlite3* database = nullptr;
      if (sqlite3_open_v2(file.c_str(), &database, SQLITE_OPEN_READONLY, nullptr) == SQLITE_OK)
        sqlite3_exec(database, "SELECT count(*) FROM snapshots", nullptr, nullptr, nullptr);
      sqlite3_close(database);
      usleep(1000);
    }
  }
  ComingAndGoing(const ComingAndGoing&) = delete;
  ComingAndGoing& operator=(const ComingAndGoing&) = delete;
  ~ComingAndGoing() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
  }

 private:
  pid_t child_;
};

void check_whole(const std::filesystem::path& file, Tick ticks) {
  const SessionReader reader = must_open(file);
  CHECK(reader.ended_cleanly());
  CHECK(reader.info().other.at("ended_why") == "finished");
  CHECK(all_ticks(reader).size() == ticks);
  CHECK(reader.check_integrity().has_value());
}

constexpr WriterOptions quick{.commit_interval = std::chrono::milliseconds(1)};

}  // namespace

TEST_CASE("a session that somebody reads at its end ends well and is whole") {
  for (const char* transaction : {"SELECT count(*) FROM snapshots", "BEGIN; SELECT count(*) FROM snapshots"})
    for (const bool may_write : {false, true}) {
      CAPTURE(transaction);
      CAPTURE(may_write);
      const TemporaryFolder folder;
      const auto file = folder / "session.sqlite";
      {
        SessionWriter writer = must_create(file, quick);
        writer.record(taken(drive_snapshot(0)));
        while (!writer.committed_tick()) std::this_thread::sleep_for(1ms);
        ForeignReader reader(file, may_write);
        REQUIRE(reader.say(transaction) == SQLITE_OK);
        for (Tick tick = 1; tick < 100; ++tick) writer.record(taken(drive_snapshot(tick)));
        const auto finished = writer.finish({{"ended_why", "finished"}});
        REQUIRE_MESSAGE(finished.has_value(), finished.error().what);
        CHECK(writer.is_still_read());
        CHECK_FALSE(writer.take_error().has_value());
        CHECK(writer.lost_records() == 0);
        check_whole(file, 100);
        // Later additions are accepted too.
        CHECK(add_answers(file, {{"paper.fun", "", "4", 4.0, 1.0, false, ""}}, "paper.").has_value());
        // A forgotten person's data may stay nowhere.
        CHECK_FALSE(write_anonymous_copy(file).has_value());
      }
      check_whole(file, 100);
      CHECK(write_anonymous_copy(file).has_value());
      CHECK_FALSE(std::filesystem::exists(file.string() + "-wal"));
    }
}

TEST_CASE("a session that is opened and closed all the time while it is written is one whole file at its end") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  const ComingAndGoing others(file);  // Also while it is made.
  SessionWriter writer = must_create(file, quick);
  for (Tick tick = 0; tick < 200; ++tick) {
    writer.record(taken(drive_snapshot(tick)));
    if (tick % 20 == 0) std::this_thread::sleep_for(5ms);
  }
  const auto finished = writer.finish({{"ended_why", "finished"}});
  REQUIRE_MESSAGE(finished.has_value(), finished.error().what);
  check_whole(file, 200);
}

TEST_CASE("another program that writes to the session for a while makes the writer wait and costs nothing") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  SessionWriter writer = must_create(file, quick);
  writer.record(taken(drive_snapshot(0)));
  while (!writer.committed_tick()) std::this_thread::sleep_for(1ms);
  std::thread other([&] {
    ForeignReader holder(file, true);
    while (holder.say("BEGIN IMMEDIATE") != SQLITE_OK) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(2500ms);  // Longer than SQLite itself waits.
  });
  for (Tick tick = 1; tick < 100; ++tick) {
    writer.record(taken(drive_snapshot(tick)));
    std::this_thread::sleep_for(1ms);
  }
  const auto finished = writer.finish({{"ended_why", "finished"}});
  other.join();
  REQUIRE_MESSAGE(finished.has_value(), finished.error().what);
  CHECK(writer.lost_records() == 0);
  check_whole(file, 100);
}

TEST_CASE("a killed drive's session takes answers and can be made anonymous") {
  const TemporaryFolder folder;
  const auto file = folder / "session.sqlite";
  {
    SessionWriter writer = must_create(file, quick);
    writer.record(taken(drive_snapshot(0)));
  }
  CHECK(add_answers(file, {{"paper.fun", "", "4", 4.0, 1.0, false, ""}}, "paper.").has_value());
  CHECK(write_anonymous_copy(file).has_value());
}

}  // namespace septet::logging
