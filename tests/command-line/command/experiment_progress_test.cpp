#include "command-line/command/experiment_progress.hpp"

#include <doctest/doctest.h>

namespace septet::server {

TEST_CASE("an experiment's progress is told in hours, and the rest in minutes at the pace of this run") {
  ExperimentProgress progress{
      .finished = 3, .subjects = 24, .driven_s = 7200, .planned_s = 36000, .driven_now_s = 5400, .wall_s = 90};
  CHECK(text_of(progress) ==
        "3 of 24 subjects, 2.00 of 10.00 h driven, 60 times as fast as real time, at most 8 min left");
  progress.planned_s = 7201;  // A minute that has begun counts whole.
  CHECK(text_of(progress).ends_with("at most 1 min left"));
  progress.driven_now_s = 0;
  CHECK(text_of(progress) ==
        "3 of 24 subjects, 2.00 of 2.00 h driven, 0 times as fast as real time, time left not known yet");
  progress.wall_s = 0;
  CHECK(text_of(progress).ends_with("time left not known yet"));
}

}  // namespace septet::server
