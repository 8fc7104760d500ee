#include "sim-client/link/heard_events.hpp"

#include <doctest/doctest.h>

namespace septet::screen {

TEST_CASE("a tick's events are there once as many as it counts were heard, and gaps are counted") {
  HeardEvents heard;
  CHECK_FALSE(heard.has(0));
  heard.take({.number = 1});
  CHECK(heard.take_all().empty());
  heard.begin(4);
  CHECK(heard.has(4));
  CHECK_FALSE(heard.has(5));
  heard.take({.number = 5});
  heard.take({.number = 5});
  heard.take({.number = 9});
  CHECK(heard.has(9));
  CHECK(heard.take_all().size() == 2);
  CHECK(heard.take_all().empty());
  CHECK(heard.take_dropped() == 3);
  CHECK(heard.take_dropped() == 0);
}

TEST_CASE("after a lost connection ticks wait for the server's reply and what happened between is counted") {
  HeardEvents heard;
  heard.begin(4);
  heard.lose();
  CHECK_FALSE(heard.has(4));
  heard.begin(10);
  CHECK(heard.has(10));
  CHECK(heard.take_dropped() == 6);
  // Another server, which has had fewer.
  heard.lose();
  heard.begin(2);
  CHECK(heard.has(2));
  CHECK_FALSE(heard.has(3));
  CHECK(heard.take_dropped() == 0);
}

TEST_CASE("a reader that takes nothing keeps a bounded number of events and is told of the others") {
  HeardEvents heard;
  heard.begin(0);
  for (std::uint64_t number = 1; number <= most_heard_events + 5; ++number) heard.take({.number = number});
  CHECK(heard.take_all().size() == most_heard_events);
  CHECK(heard.take_dropped() == 5);
}

}  // namespace septet::screen
