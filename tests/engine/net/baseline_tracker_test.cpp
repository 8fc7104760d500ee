#include "engine/net/baseline_tracker.hpp"

#include <doctest/doctest.h>

namespace septet::net {
namespace {

TEST_CASE("the baseline is the newest tick that every live client acknowledged") {
  BaselineTracker tracker;
  CHECK(!tracker.baseline());
  tracker.join(1, 0.0);
  tracker.join(2, 0.0);
  CHECK(!tracker.baseline());
  for (const std::uint64_t tick : {1, 2, 3, 5}) tracker.acknowledge(1, tick, 0.1);
  CHECK(!tracker.baseline());
  for (const std::uint64_t tick : {4, 2, 1}) tracker.acknowledge(2, tick, 0.1);
  CHECK(tracker.baseline() == 2);
  tracker.acknowledge(2, 5, 0.1);
  CHECK(tracker.baseline() == 5);
}

TEST_CASE("a silent client no longer holds the baseline back and forces a keyframe when it returns") {
  BaselineTracker tracker;
  tracker.join(1, 0.0);
  tracker.join(2, 0.0);
  tracker.acknowledge(1, 1, 0.0);
  tracker.acknowledge(2, 1, 0.0);
  tracker.acknowledge(1, 40, 0.4);
  tracker.advance_to(0.4);
  CHECK(tracker.baseline() == 1);
  tracker.acknowledge(1, 60, 0.6);
  tracker.advance_to(0.6);
  CHECK(tracker.baseline() == 60);
  CHECK_FALSE(tracker.is_live(2));
  tracker.heard(2, 0.7);
  tracker.advance_to(0.7);
  CHECK(tracker.is_live(2));
  CHECK(!tracker.baseline());
  tracker.acknowledge(2, 60, 0.75);
  CHECK(tracker.baseline() == 60);
}

TEST_CASE("a client that leaves no longer counts") {
  BaselineTracker tracker;
  tracker.join(1, 0.0);
  tracker.join(2, 0.0);
  tracker.acknowledge(1, 7, 0.0);
  tracker.leave(2);
  CHECK(tracker.baseline() == 7);
}

TEST_CASE("a client that asks but never acknowledges spoils only half a second of every two and a half") {
  BaselineTracker tracker;
  tracker.join(1, 0.0);
  tracker.join(2, 0.0);
  int keyframes = 0;
  for (int tick = 1; tick <= 1000; ++tick) {
    const double now_s = tick / 100.0;
    tracker.acknowledge(1, static_cast<std::uint64_t>(tick), now_s);
    tracker.join(2, now_s);
    tracker.advance_to(now_s);
    if (!tracker.baseline()) ++keyframes;
  }
  CHECK(keyframes > 100);
  CHECK(keyframes < 260);
}

TEST_CASE("a tracker remembers a bounded number of ticks per client") {
  BaselineTracker tracker({.history = 4});
  tracker.join(1, 0.0);
  tracker.join(2, 0.0);
  for (std::uint64_t tick = 1; tick <= 10; ++tick) tracker.acknowledge(1, tick, 0.0);
  tracker.acknowledge(2, 6, 0.0);
  CHECK(!tracker.baseline());
  tracker.acknowledge(2, 7, 0.0);
  CHECK(tracker.baseline() == 7);
}

TEST_CASE("a client is live for exactly half a second of silence and nobody acknowledges a tick twice") {
  BaselineTracker tracker({.silence_s = 0.5, .history = 2});
  tracker.join(1, 0.0);
  for (const std::uint64_t tick : {3, 4, 4, 4}) tracker.acknowledge(1, tick, 0.0);
  tracker.advance_to(0.5);
  CHECK(tracker.is_live(1));
  // Repeated acknowledgements of one tick do not push out older ticks.
  tracker.join(2, 0.5);
  tracker.acknowledge(2, 3, 0.5);
  CHECK(tracker.baseline() == 3);
  tracker.advance_to(0.5625);
  CHECK_FALSE(tracker.is_live(1));
  CHECK(tracker.is_live(2));
  tracker.acknowledge(7, 3, 0.6);  // From a client that never joined.
  CHECK_FALSE(tracker.is_live(7));
}

TEST_CASE("a client that joins anew has acknowledged nothing") {
  BaselineTracker tracker;
  tracker.join(1, 0.0);
  tracker.acknowledge(1, 9, 0.1);
  CHECK(tracker.baseline() == 9);
  tracker.join(1, 0.2);
  CHECK(tracker.is_live(1));
  CHECK_FALSE(tracker.baseline());
}

}  // namespace
}  // namespace septet::net
