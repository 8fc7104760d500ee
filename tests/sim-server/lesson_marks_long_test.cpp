// Every lesson from end to end, in ten seeds, by the novice and the experienced driver: marks separate them, and every
// mark can be lost.
//
//     ./test --long -R 'every lesson'

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include "logging/study/statistics/compare.hpp"
#include "tests/sim-server/taken_lesson.hpp"

namespace septet::server {
namespace {

constexpr std::uint64_t lesson_seeds = 10;

struct LessonLength {
  const char* scenario;
  double seconds;
};
/// Each until its own end, or until its driver has come to stand.
constexpr LessonLength lessons[] = {
    {"first-lesson", 320.0}, {"behind-ambulance", 300.0}, {"winter-lorry", 75.0}, {"tunnel-fire", 60.0}};

}  // namespace

TEST_CASE(
    "in every lesson novices get clearly worse marks than experienced drivers, and every task costs somebody "
    "something") {
  for (const LessonLength& each : lessons) {
    std::map<std::string, std::vector<double>> totals;
    std::map<std::string, double> lowest;
    for (std::uint64_t seed = 1; seed <= lesson_seeds; ++seed)
      for (const char* driver : {"experienced", "novice"}) {
        const TakenLesson taken = take_lesson(each.scenario, driver, seed, each.seconds);
        totals[driver].push_back(taken.marks.mark.value());
        for (std::size_t i = 0; i < taken.lesson.tasks.size(); ++i) {
          const auto [at, is_new] = lowest.try_emplace(taken.lesson.tasks[i].id, 10.0);
          at->second = std::min(at->second, taken.marks.tasks[i].mark.value_or(10.0));
        }
      }
    const auto effect = logging::hedges_g(totals["experienced"], totals["novice"]);
    REQUIRE(effect.has_value());
    MESSAGE(std::string(each.scenario) << ": experienced " << logging::summarise(totals["experienced"]).mean
                                       << ", novice " << logging::summarise(totals["novice"]).mean << "; Hedges' g "
                                       << effect->g << ", 95 % " << effect->low << " to " << effect->high);
    CHECK(effect->low > 0.0);
    for (const auto& [task, mark] : lowest) {
      INFO(std::string(each.scenario) << ", " << task);
      // There are no contacts on a motorway; tests/logging/lesson_test.cpp tests the mark of a collision.
      if (task != "collision") CHECK(mark < 10.0);
    }
  }
}

}  // namespace septet::server
