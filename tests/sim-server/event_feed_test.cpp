#include "sim-server/host/event_feed.hpp"

#include <cstdint>
#include <map>
#include <vector>

#include <doctest/doctest.h>

namespace septet::server {

TEST_CASE("a hearer is told each event after it came, in order and once, and who left is told nothing") {
  EventFeed feed;
  std::map<std::uint32_t, std::vector<std::uint64_t>> told;
  const auto tell = [&](std::uint32_t hearer, const control::DriveEvent& event) {
    told[hearer].push_back(event.number);
  };
  feed.add({.kind = "mark"});
  CHECK(feed.join(1) == 1);
  feed.add({.kind = "collision"});
  CHECK(feed.join(2) == 2);
  CHECK(feed.join(1) == 1);
  feed.add({.kind = "lane_change"});
  feed.pump(tell);
  feed.pump(tell);
  feed.leave(2);
  feed.add({.kind = "mark"});
  feed.pump(tell);
  CHECK(feed.count() == 4);
  CHECK(told[1] == std::vector<std::uint64_t>{2, 3, 4});
  CHECK(told[2] == std::vector<std::uint64_t>{3});
}

TEST_CASE("a burst of events is told in parts, and beyond what is kept the oldest are dropped") {
  EventFeed feed;
  feed.join(1);
  std::vector<std::uint64_t> told;
  for (std::size_t i = 0; i < most_events_kept + 10; ++i) feed.add({.kind = "mark"});
  const auto pump = [&] { feed.pump([&](std::uint32_t, const control::DriveEvent& e) { told.push_back(e.number); }); };
  pump();
  CHECK(told.size() == most_events_per_pump);
  CHECK(told.front() == 11);
  for (std::size_t i = 0; i < most_events_kept / most_events_per_pump; ++i) pump();
  CHECK(told.size() == most_events_kept);
  CHECK(told.back() == feed.count());
}

}  // namespace septet::server
