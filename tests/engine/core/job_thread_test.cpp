#include "engine/core/job_thread.hpp"

#include <cstddef>
#include <future>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("jobs are done in order and the end of the thread does what waits") {
  std::vector<int> done;
  {
    JobThread<int> thread(4, [&](int& job) -> Expected<void> {
      done.push_back(job);
      return {};
    });
    for (int job = 0; job < 100; ++job) REQUIRE(thread.give(job).has_value());
  }
  REQUIRE(done.size() == 100);
  for (int job = 0; job < 100; ++job) CHECK(done[std::size_t(job)] == job);
}

TEST_CASE("who waits and who gives the next job hear of the first failure, and no job is done that was refused") {
  std::vector<int> done;
  JobThread<int> thread(4, [&](int& job) -> Expected<void> {
    done.push_back(job);
    if (job < 0) return failure("job " + std::to_string(job), "here", "none");
    return {};
  });
  REQUIRE(thread.give(1).has_value());
  REQUIRE(thread.give(-1).has_value());
  const auto waited = thread.wait();
  REQUIRE_FALSE(waited.has_value());
  CHECK(waited.error().what == "job -1");
  CHECK(thread.give(-2).error().what == "job -1");
  CHECK(thread.wait().error().what == "job -1");
  CHECK(done == std::vector{1, -1});
}

TEST_CASE("a job for idle times is dropped while one is being done or waits") {
  std::promise<void> begun, may_end;
  std::vector<int> done;
  JobThread<int> thread(4, [&](int& job) -> Expected<void> {
    done.push_back(job);
    if (job == 1) {
      begun.set_value();
      may_end.get_future().wait();
    }
    return {};
  });
  REQUIRE(thread.give(1).has_value());
  begun.get_future().wait();
  thread.give_if_idle(2);
  may_end.set_value();
  REQUIRE(thread.wait().has_value());
  CHECK(done == std::vector{1});
  thread.give_if_idle(3);
  REQUIRE(thread.wait().has_value());
  CHECK(done == std::vector{1, 3});
}

}  // namespace septet
