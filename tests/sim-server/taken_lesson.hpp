#pragma once
/// A shipped lesson, taken by a simulated driver.

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "logging/study/lesson/lesson.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/sim-server/simulated_drive.hpp"

namespace septet::server {

struct TakenLesson {
  logging::Lesson lesson;
  logging::LessonMarks marks;
};

inline TakenLesson take_lesson(const std::string& scenario, const std::string& driver, std::uint64_t seed,
                               double seconds) {
  const LoadedDrive loaded = shipped_drive(scenario, "seven-screens", seed);
  const auto drive = simulated_drive(loaded, driver, seed);
  std::vector<logging::Sample> samples;
  std::vector<logging::Event> events;
  drive->watch_events([&](const simulation::Event& event, double now_s) {
    events.push_back({0, now_s, event.kind, event.participant, event.detail});
  });
  while (drive->newest().simulated_time_s < seconds) {
    const auto next = drive->next(std::nullopt);
    if (!next || !*next) break;
    const Snapshot& now = drive->newest();
    if (logging::is_sample_due(now.tick, simulation::tick_rate_hz))
      samples.push_back(logging::take_sample(now, find_leader(now, loaded.model->roads)));
  }
  const auto lesson = logging::read_lesson(loaded.source(logging::lesson_role), scenario);
  REQUIRE(lesson.has_value());
  return {*lesson, logging::mark_lesson(*lesson, samples, events)};
}

}  // namespace septet::server
