#include "engine/core/bounded_queue.hpp"

#include <thread>

#include <doctest/doctest.h>

namespace septet {

TEST_CASE("a full queue refuses a value and leaves it with the caller") {
  BoundedQueue<std::vector<int>> queue(1);
  std::vector<int> first{1}, second{2, 3};
  CHECK(queue.try_push(first));
  CHECK_FALSE(queue.try_push(second));
  CHECK(second.size() == 2);
}

TEST_CASE("a queue is full by the sizes of its values whatever their number and wakes the taker then") {
  BoundedQueue<int> queue(100);
  int value = 1;
  CHECK(queue.try_push(value, 60));
  CHECK(queue.try_push(value, 60));  // Below the bound there is room for a value of any size.
  CHECK_FALSE(queue.try_push(value, 1));
  std::vector<int> batch;
  REQUIRE(queue.take_all(batch, std::chrono::steady_clock::now() + std::chrono::hours(1), 32));
  CHECK(batch.size() == 2);
  CHECK(queue.try_push(value, 1));
}

TEST_CASE("values of several threads all arrive each thread's in order") {
  BoundedQueue<std::pair<int, int>> queue(8);
  std::vector<std::jthread> writers;
  for (int writer = 0; writer < 3; ++writer)
    writers.emplace_back([&queue, writer] {
      for (int i = 0; i < 1000; ++i) {
        std::pair value(writer, i);
        queue.push(value);
      }
    });
  int next[3] = {0, 0, 0};
  std::vector<std::pair<int, int>> batch;
  while (next[0] + next[1] + next[2] < 3000) {
    REQUIRE(queue.take_all(batch, std::chrono::steady_clock::now() + std::chrono::minutes(5)));
    CHECK(batch.size() <= 8);
    for (const auto& [writer, i] : batch) REQUIRE(i == next[writer]++);
  }
}

TEST_CASE("a closed queue gives what it holds and wakes who waits") {
  BoundedQueue<int> queue(1);
  int value = 1;
  queue.push(value);
  std::jthread waiting([&queue] {
    int other = 2;
    CHECK_FALSE(queue.push(other));
  });
  queue.close();
  waiting.join();
  std::vector<int> batch;
  CHECK(queue.take_all(batch, std::chrono::steady_clock::now()));
  CHECK(batch == std::vector{1});
  CHECK_FALSE(queue.take_all(batch, std::chrono::steady_clock::now()));
}

}  // namespace septet
