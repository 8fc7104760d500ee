// The shipped lessons, taken by simulated drivers: every task has an occasion, and better drivers get better marks.
//
// The whole of it, ten seeds of each lesson from end to end, is lesson_marks_long_test.cpp.

#include <algorithm>
#include <string>
#include <vector>

#include "logging/study/statistics/compare.hpp"
#include "tests/sim-server/taken_lesson.hpp"

namespace septet::server {
namespace {

logging::EffectSize effect_of_experience(const std::string& scenario, std::uint64_t seeds, double seconds) {
  std::vector<double> experienced, novice;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    experienced.push_back(take_lesson(scenario, "experienced", seed, seconds).marks.mark.value());
    novice.push_back(take_lesson(scenario, "novice", seed, seconds).marks.mark.value());
  }
  const auto effect = logging::hedges_g(experienced, novice);
  REQUIRE(effect.has_value());
  MESSAGE(scenario << ": Hedges' g " << effect->g << ", 95 % " << effect->low << " to " << effect->high);
  return *effect;
}

}  // namespace

TEST_CASE("novices get worse marks than experienced drivers") {
  CHECK(effect_of_experience("first-lesson", 4, 190.0).low > 0.0);
  CHECK(effect_of_experience("behind-ambulance", 4, 110.0).low > 0.0);
  CHECK(effect_of_experience("tunnel-fire", 3, 30.0).low > 0.0);
}

TEST_CASE("the first lesson sees all that it marks, and an experienced driver passes it") {
  const TakenLesson novice = take_lesson("first-lesson", "novice", 1, 240.0);
  const TakenLesson experienced = take_lesson("first-lesson", "experienced", 1, 240.0);
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

TEST_CASE("the halt before a fire is seen and marked") {
  const TakenLesson taken = take_lesson("tunnel-fire", "plain", 1, 32.0);
  for (std::size_t i = 0; i < taken.lesson.tasks.size(); ++i) {
    INFO(taken.lesson.tasks[i].id);
    CHECK(taken.marks.tasks[i].mark.has_value());
  }
}

}  // namespace septet::server
