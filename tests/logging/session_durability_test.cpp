#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

std::atomic<int> log_syncs;
sqlite3_io_methods watched_methods;
int (*true_sync)(sqlite3_file*, int);
decltype(sqlite3_vfs::xOpen) true_open;

int counted_sync(sqlite3_file* file, int flags) {
  ++log_syncs;
  return true_sync(file, flags);
}

int watched_open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  const int status = true_open(vfs, name, file, flags, out_flags);
  if (status != SQLITE_OK || !(flags & SQLITE_OPEN_WAL)) return status;
  watched_methods = *file->pMethods;
  true_sync = file->pMethods->xSync;
  watched_methods.xSync = counted_sync;
  file->pMethods = &watched_methods;
  return status;
}

/// SQLite's files as ever, but for the write-ahead log, whose syncs are counted.
struct WatchedFiles {
  WatchedFiles() : vfs(*sqlite3_vfs_find(nullptr)) {
    true_open = vfs.xOpen;
    vfs.zName = "watched";
    vfs.xOpen = watched_open;
    sqlite3_vfs_register(&vfs, 1);
  }
  ~WatchedFiles() { sqlite3_vfs_unregister(&vfs); }
  sqlite3_vfs vfs;
};

}  // namespace

TEST_CASE("what is committed has reached the disk and outlives a power cut") {
  const WatchedFiles files;
  const TemporaryFolder folder;
  SessionWriter writer = must_create(folder / "session.sqlite", {.commit_interval = std::chrono::milliseconds(1)});
  for (Tick tick = 0; tick < 5; ++tick) {
    const int before = log_syncs;
    writer.record(taken(drive_snapshot(tick)));
    while (writer.committed_tick() != tick) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    CHECK(log_syncs > before);
  }
  REQUIRE(writer.finish());
}

}  // namespace septet::logging
