// The shipped lessons, taken by simulated drivers: everything that is marked is seen, and who drives better gets the better mark.

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "logging/lesson/lesson.hpp"
#include "sim-server/drive/driver_seat.hpp"
#include "sim-server/drive/live_drive.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {
namespace {

struct TakenLesson {
  logging::Lesson lesson;
  logging::LessonMarks marks;
};

TakenLesson take_lesson(const std::string& scenario, const std::string& driver, std::uint64_t seed, double seconds) {
  const LoadedDrive loaded = shipped_drive(scenario, "seven-screens", seed);
  auto seat = open_driver_seat(rig::Car{.driver = driver}, seed, loaded.model);
  REQUIRE(seat.has_value());
  auto drive = LiveDrive::start(loaded.model, traffic::own_traffic(loaded.model->roads, seed), std::move(*seat));
  REQUIRE(drive.has_value());
  std::vector<logging::Sample> samples;
  std::vector<logging::Event> events;
  (*drive)->watch_events([&](const simulation::Event& event, double now_s) {
    events.push_back({0, now_s, event.kind, event.participant, event.detail});
  });
  while ((*drive)->newest().simulated_time_s < seconds) {
    const auto next = (*drive)->next(std::nullopt);
    if (!next || !*next) break;
    const Snapshot& now = (*drive)->newest();
    if (logging::is_sample_due(now.tick, simulation::tick_rate_hz))
      samples.push_back(logging::take_sample(now, find_leader(now, loaded.model->roads)));
  }
  const auto lesson = logging::read_lesson(loaded.source(logging::lesson_role), scenario);
  REQUIRE(lesson.has_value());
  return {*lesson, logging::mark_lesson(*lesson, samples, events)};
}

}  // namespace

TEST_CASE("novices get worse marks than experienced drivers") {
  for (const std::string scenario : {"winter-lorry", "behind-ambulance"}) {
    const double novice = take_lesson(scenario, "novice", 1, 70.0).marks.mark.value();
    const double experienced = take_lesson(scenario, "experienced", 1, 70.0).marks.mark.value();
    MESSAGE(scenario << ": novice " << novice << ", experienced " << experienced);
    CHECK(novice + 0.2 < experienced);
  }
}

TEST_CASE("the first lesson sees all that it marks, and a novice drives it worse than an experienced driver") {
  const auto take = [](const char* driver) { return take_lesson("first-lesson", driver, 1, 240.0); };
  const TakenLesson novice = take("novice"), experienced = take("experienced");
  for (std::size_t i = 0; i < experienced.lesson.tasks.size(); ++i) {
    INFO(experienced.lesson.tasks[i].id);
    CHECK(novice.marks.tasks[i].mark.has_value());
    CHECK(experienced.marks.tasks[i].mark.has_value());
    CHECK(experienced.marks.tasks[i].severity != logging::Severity::dangerous);
  }
  MESSAGE("novice " << *novice.marks.mark << ", experienced " << *experienced.marks.mark);
  CHECK(*novice.marks.mark + 0.5 < *experienced.marks.mark);
  CHECK(experienced.marks.passed);
}

TEST_CASE("the halt before a fire is seen and marked, and who has switched no hazard lights on is told so") {
  const TakenLesson taken = take_lesson("tunnel-fire", "plain", 1, 40.0);
  for (std::size_t i = 0; i < taken.lesson.tasks.size(); ++i) {
    const logging::LessonTask& task = taken.lesson.tasks[i];
    INFO(task.id);
    CHECK(taken.marks.tasks[i].mark.has_value());
    if (task.id == "hazard") CHECK(taken.marks.tasks[i].severity == logging::Severity::serious);
  }
}

}  // namespace septet::server
