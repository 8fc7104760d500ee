#include <algorithm>
#include <atomic>
#include <csignal>
#include <functional>

#include <doctest/doctest.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

/// Progress of a writer, seen by its process and by its killer.
struct Progress {
  std::atomic<std::int64_t> recorded{0};   ///< Ticks handed to the writer.
  std::atomic<std::int64_t> committed{0};  ///< Those of them that the writer calls safe.
};

/// A process that records `ticks` ticks, one about every 2 ms, and then waits to be killed.
[[noreturn]] void write_until_killed(const std::filesystem::path& path, std::int64_t ticks, Progress& progress) {
  auto writer = SessionWriter::create(path, example_info());
  if (!writer) _exit(1);
  for (std::int64_t tick = 0;; usleep(2000)) {
    if (tick < ticks) {
      writer->record(taken(drive_snapshot(static_cast<Tick>(tick), 50)));
      progress.recorded.store(++tick);
    }
    if (const auto committed = writer->committed_tick())
      progress.committed.store(static_cast<std::int64_t>(*committed) + 1);
  }
}

/// Content of a session whose writer was killed once `is_time` held.
struct Killed {
  std::int64_t committed = 0;  ///< Ticks that were safe before.
  std::int64_t recorded = 0;
  std::int64_t found = 0;
};

Killed kill_writer(std::int64_t ticks, const std::function<bool(const Progress&)>& is_time) {
  void* memory = mmap(nullptr, sizeof(Progress), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  auto& progress = *new (memory) Progress;
  const TemporaryFolder folder;
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) write_until_killed(folder / "session.sqlite", ticks, progress);
  while (!is_time(progress)) usleep(100);
  Killed killed{.committed = progress.committed.load()};
  kill(child, SIGKILL);
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  killed.recorded = progress.recorded.load();
  munmap(memory, sizeof(Progress));

  const SessionReader reader = must_open(folder / "session.sqlite");
  CHECK(reader.check_integrity().has_value());
  CHECK_FALSE(reader.ended_cleanly());
  const auto found = all_ticks(reader);
  for (std::size_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == i);
  killed.found = static_cast<std::int64_t>(found.size());
  return killed;
}

}  // namespace

TEST_CASE("kill -9 at any moment loses nothing that was committed and the file opens") {
  for (const std::int64_t moment : {1, 2, 7, 15, 26, 49, 100, 233, 377}) {
    // Commits follow by the clock, at any moment of the drive.
    const auto killed = kill_writer(1'000'000, [&](const Progress& progress) {
      return progress.recorded >= moment && (moment < 100 || progress.committed > 0);
    });
    CAPTURE(moment);
    CHECK(killed.found >= killed.committed);
    CHECK(killed.found <= killed.recorded + 1);  // One may have been on its way.
    MESSAGE("killed after ", killed.recorded, " ticks, of which ", killed.committed, " were committed: the file has ",
            killed.found);
  }
}

TEST_CASE("what was recorded last is committed though nothing comes after it") {
  const auto killed = kill_writer(30, [](const Progress& progress) { return progress.committed >= 30; });
  CHECK(killed.found == 30);
}

}  // namespace septet::logging
