#include <doctest/doctest.h>

#include "sim-server/drive/lesson_watch.hpp"

namespace septet::server {
namespace {

logging::Lesson two_tasks() {
  const auto lesson = logging::read_lesson(R"(
title = "T"
aim = "A"
shortest_s = 60.0
[[task]]
id = "speed"
says = "Keep to 80"
measure = "speed"
bound = 80.0
tolerance = 20.0
[[task]]
id = "position"
says = "Keep to the middle"
measure = "position"
bound = 0.5
tolerance = 0.5
)",
                                           "x.lesson.toml");
  REQUIRE(lesson.has_value());
  return *lesson;
}

logging::Sample sample_at(int i, double speed_mps, double lateral_m) {
  logging::Sample sample;
  sample.tick = static_cast<Tick>(12 * i);
  sample.simulated_time_s = 0.1 * i;
  sample.speed_mps = speed_mps;
  sample.lane = -1;
  sample.lane_width_m = 3.5;
  sample.lateral_position_m = lateral_m;
  return sample;
}

std::shared_ptr<const std::string> picture(const std::string& what) {
  return std::make_shared<const std::string>(what);
}

}  // namespace

TEST_CASE(
    "a fault is told while the lesson goes on, with the picture nearest to it, and the mark before the lesson's "
    "shortest time") {
  LessonWatch watch(two_tasks());
  CHECK(watch.facts().tasks[0].measure == "speed");
  CHECK(watch.facts().tasks[1].unit == "m");
  for (int i = 0; i < 100; ++i) {
    if (i % 10 == 0) watch.add_still(0.1 * i, picture(std::to_string(i)));
    watch.add(sample_at(i, i >= 50 && i < 60 ? 25.0 : 20.0, i == 30 ? 0.7 : 0.0));
  }
  watch.finish();
  const auto view = watch.view();
  REQUIRE(view);
  REQUIRE(view->faults.size() == 2);
  CHECK(view->faults[0].task == 1);
  CHECK(*view->faults[0].still == "30");
  CHECK(view->faults[1].severity == "minor");
  CHECK(*view->faults[1].still == "50");
  CHECK(view->tasks[0].faults == 1);
  REQUIRE(view->mark.has_value());
  CHECK(*view->mark < 10.0);
  CHECK(watch.view() == view);
}

TEST_CASE("what a change of lanes may still excuse is not told yet, and a fault keeps its number and picture") {
  LessonWatch watch(two_tasks());
  watch.add_still(2.0, picture("then"));
  for (int i = 0; i < 40; ++i) watch.add(sample_at(i, 20.0, i >= 20 ? 0.7 : 0.0));
  watch.finish();
  REQUIRE(watch.view());
  CHECK(watch.view()->faults.empty());
  for (int i = 40; i < 80; ++i) watch.add(sample_at(i, 20.0, 0.7));
  watch.finish();
  REQUIRE(watch.view()->faults.size() == 1);
  const auto first = watch.view()->faults[0];
  watch.add_still(8.0, picture("now"));
  for (int i = 80; i < 100; ++i) watch.add(sample_at(i, 20.0, 0.9));
  watch.finish();
  REQUIRE(watch.view()->faults.size() == 1);
  const auto later = watch.view()->faults[0];
  CHECK(later.number == first.number);
  CHECK(later.still == first.still);
  CHECK(later.to_s > first.to_s);
  CHECK(later.worst == 0.9);
}

}  // namespace septet::server
