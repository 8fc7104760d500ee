#pragma once
/// A shipped lesson, taken by a simulated driver and marked by what its log is told.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "logging/study/lesson/lesson.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/sim-server/simulated_drive.hpp"
#include "tests/temporary_folder.hpp"

namespace septet::server {

/// What the log was told of a drive by a simulated driver.
struct TakenDrive {
  LoadedDrive loaded;
  std::vector<logging::Sample> samples;
  std::vector<logging::Event> events;
};

inline TakenDrive take_drive(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                             double seconds) {
  TakenDrive taken{shipped_drive(scenario, "seven-screens", seed), {}, {}};
  const auto drive = simulated_drive(taken.loaded, driver, seed);
  const TemporaryFolder folder;
  auto log = SessionLog::create(taken.loaded, {.out = folder.path(), .log_samples_only = true, .no_screens = true});
  REQUIRE(log.has_value());
  log->watch([&](const logging::Sample& sample) { taken.samples.push_back(sample); },
             [&](const logging::Event& event) { taken.events.push_back(event); });
  drive->log_to(*log);
  while (drive->newest().simulated_time_s < seconds) {
    const auto next = drive->next(std::nullopt);
    if (!next || !*next) break;
  }
  return taken;
}

struct TakenLesson {
  logging::Lesson lesson;
  logging::LessonMarks marks;
};

inline TakenLesson take_lesson(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                               double seconds) {
  const TakenDrive taken = take_drive(scenario, driver, seed, seconds);
  const auto lesson = logging::read_lesson(taken.loaded.source(logging::lesson_role), scenario);
  REQUIRE(lesson.has_value());
  return {*lesson, logging::mark_lesson(*lesson, taken.samples, taken.events)};
}

}  // namespace septet::server
