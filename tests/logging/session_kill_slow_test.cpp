#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>

#include <doctest/doctest.h>
#include <sys/mman.h>
#include <sys/wait.h>

#include "tests/logging/session_fixture.hpp"

namespace septet::logging {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t most_ticks = 20000;

/// When each tick was handed to the writer, seen by parent and child.
struct SharedTimes {
  std::atomic<std::size_t> ticks{0};
  std::array<Clock::time_point, most_ticks> recorded_at;
};

[[noreturn]] void write_until_killed(const std::filesystem::path& path, SharedTimes& times) {
  auto writer = SessionWriter::create(path, example_info());
  if (!writer) _exit(1);
  for (Tick tick = 0; tick < most_ticks; ++tick) {
    const auto snapshot = taken(drive_snapshot(tick, 50));
    times.recorded_at[tick] = Clock::now();
    writer->record(snapshot);
    times.ticks.store(tick + 1);
    usleep(8333);
  }
  _exit(2);
}

}  // namespace

TEST_CASE("kill -9 at any moment loses at most the last 100 ms and the file opens") {
  void* memory =
      mmap(nullptr, sizeof(SharedTimes), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  REQUIRE(memory != MAP_FAILED);
  for (const int moment_ms : {20, 51, 100, 149, 233, 377, 610, 987, 1597}) {
    auto& times = *new (memory) SharedTimes;
    const TemporaryFolder folder;
    const auto path = folder / "session.sqlite";
    const pid_t child = fork();
    REQUIRE(child >= 0);
    if (child == 0) write_until_killed(path, times);
    while (times.ticks.load() == 0) usleep(100);
    usleep(static_cast<useconds_t>(moment_ms) * 1000);
    const auto killed_at = Clock::now();
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    REQUIRE(WIFSIGNALED(status));

    const SessionReader reader = must_open(path);
    const auto ticks = all_ticks(reader);
    CHECK(reader.check_integrity().has_value());
    CHECK_FALSE(reader.ended_cleanly());
    const std::size_t recorded = times.ticks.load();
    REQUIRE(ticks.size() <= recorded + 1);
    for (std::size_t i = 0; i < ticks.size(); ++i) REQUIRE(ticks[i] == i);
    if (ticks.size() < recorded) {
      const std::chrono::duration<double, std::milli> lost =
          killed_at - times.recorded_at[ticks.size()];
      // On a busy machine every thread is late, the writer's too: about as late as the ticks, which should be 8 ms apart.
      std::chrono::duration<double, std::milli> longest{0.0};
      for (std::size_t i = 1; i < recorded; ++i) longest = std::max<decltype(longest)>(longest, times.recorded_at[i] - times.recorded_at[i - 1]);
      const double busy_ms = std::max(0.0, longest.count() - 2 * 8.333);
      MESSAGE("killed after ", moment_ms, " ms: lost the last ", lost.count(), " ms; ticks were up to ", longest.count(), " ms apart");
      CHECK(lost.count() <= 100.0 + 4.0 * busy_ms);
    }
  }
  munmap(memory, sizeof(SharedTimes));
}

}  // namespace septet::logging
