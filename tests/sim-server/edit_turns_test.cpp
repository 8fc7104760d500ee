#include "sim-server/attendants/edit_turns.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

namespace septet::server {
namespace {

SceneRequest asked(const std::string& editor, std::uint64_t number, std::size_t commands, Tick tick = 0) {
  return {1,
          {editor, {}, 1000},
          {number, tick, 20 * commands, std::vector<scene::Command>(commands, scene::HideSet{1, true})}};
}

/// Commands done at one tick, by editors.
std::map<std::string, std::size_t> done_at(EditTurns& turns, Tick tick) {
  std::map<std::string, std::size_t> done;
  turns.begin_tick(tick);
  while (const auto request = turns.next()) done[request->editor.name] += request->batch.changes.size();
  return done;
}

/// The numbers of the batches done at one tick, in their order.
std::vector<std::uint64_t> numbers_at(EditTurns& turns, Tick tick) {
  std::vector<std::uint64_t> numbers;
  turns.begin_tick(tick);
  while (const auto request = turns.next()) numbers.push_back(request->batch.number);
  return numbers;
}

}  // namespace

TEST_CASE("of an editor that floods a tick does no more than its share, and all of it in the end, in its order") {
  EditTurns turns;
  turns.begin_tick(1);
  constexpr std::uint64_t batches = 2000;
  for (std::uint64_t number = 1; number <= batches; ++number) turns.add(asked("lab", number, 10));
  std::vector<std::uint64_t> order;
  Tick tick = 1;
  for (; order.size() < batches && tick < 1000; ++tick) {
    const auto numbers = numbers_at(turns, tick);
    CHECK(10 * numbers.size() < most_edit_work_a_tick + 10);
    order.insert(order.end(), numbers.begin(), numbers.end());
  }
  REQUIRE(order.size() == batches);
  for (std::uint64_t i = 0; i < batches; ++i) CHECK(order[i] == i + 1);
  CHECK(tick >= 10 * batches / most_edit_work_a_tick);
  CHECK(tick < 10 * batches / most_edit_work_a_tick + 4);
}

TEST_CASE(
    "a batch of more than a tick's share is done whole, and its editor's next waits as long as its size is owed") {
  EditTurns turns;
  turns.begin_tick(1);
  turns.add(asked("lab", 1, 10'000));
  turns.add(asked("lab", 2, 1));
  CHECK(numbers_at(turns, 1) == std::vector<std::uint64_t>{1});
  Tick tick = 2;
  while (tick < 1000 && numbers_at(turns, tick).empty()) ++tick;
  CHECK(tick - 1 == 10'000 / most_edit_work_a_tick);
}

TEST_CASE("while others flood, an editor's change is done at its tick, and many that flood take turns") {
  EditTurns turns;
  turns.begin_tick(1);
  for (const std::string flood : {"a", "b", "c", "d", "e", "y", "z"})
    for (std::uint64_t number = 0; number < 200; ++number) turns.add(asked(flood, number, 100));
  std::map<std::string, std::size_t> all;
  for (Tick tick = 1; tick <= 40; ++tick) {
    turns.add(asked("lab", tick, 1));
    const auto done = done_at(turns, tick);
    std::size_t together = 0;
    for (const auto& [editor, commands] : done) together += commands, all[editor] += commands;
    CHECK(together < most_edit_work_of_all_a_tick + 100);
    CHECK(all["lab"] + 1 >= tick);
  }
  for (const auto& one : all) {
    CAPTURE(one.first);
    if (one.first != "lab") CHECK(one.second >= 5 * most_edit_work_a_tick);
  }
}

TEST_CASE("what names a tick waits for it, before what comes after it, and is not held by its share until then") {
  EditTurns turns;
  turns.begin_tick(1);
  turns.add(asked("lab", 1, 1, 5));
  turns.add(asked("lab", 2, 1, 3));
  turns.add(asked("lab", 3, 1));
  CHECK(numbers_at(turns, 1) == std::vector<std::uint64_t>{3});
  CHECK(numbers_at(turns, 2).empty());
  CHECK(numbers_at(turns, 7) == std::vector<std::uint64_t>{2, 1});
}

TEST_CASE("an editor's queue has a bound, which is its own, and has room again when its turns have come") {
  EditTurns turns;
  turns.begin_tick(1);
  std::size_t taken = 0;
  for (; taken < 100'000 && !turns.refusal(asked("lab", taken, 10'000)); ++taken)
    turns.add(asked("lab", taken, 10'000));
  CHECK(taken > 5);
  CHECK(taken * 10'000 * sizeof(scene::Command) <= most_edit_bytes_waiting);
  CHECK_FALSE(turns.refusal(asked("desk", 1, 10'000)));
  CHECK(numbers_at(turns, 1).size() == 1);
  CHECK_FALSE(turns.refusal(asked("lab", taken, 10'000)));
}

TEST_CASE("a batch may name a tick of the longest lifetime from now, and no later one") {
  EditTurns turns;
  turns.begin_tick(50);
  CHECK_FALSE(turns.refusal(asked("lab", 1, 1, 50 + most_ticks_ahead)));
  const auto why_not = turns.refusal(asked("lab", 1, 1, 51 + most_ticks_ahead));
  REQUIRE(why_not);
  CHECK(why_not->starts_with("tick 120000051 is more than 120000000 ticks ahead of 50"));
}

TEST_CASE("fifty moves a tick, and a batch of as much content as there can be, wait for nothing") {
  EditTurns turns;
  for (Tick tick = 1; tick <= 100; ++tick) {
    turns.begin_tick(tick);
    for (std::uint64_t number = 0; number < 50; ++number) turns.add(asked("lab", number, 1));
    SceneRequest content = asked("desk", 1, 30);
    content.batch.bytes = replication::max_batch_bytes - most_edit_work_a_tick * 32;
    if (tick % 2 == 0) turns.add(std::move(content));
    std::map<std::string, std::size_t> done;
    while (const auto request = turns.next()) done[request->editor.name] += request->batch.changes.size();
    CHECK(done["lab"] == 50);
    CHECK(done["desk"] == (tick % 2 == 0 ? 30 : 0));
  }
}

}  // namespace septet::server
