#include "sim-server/host/playout_planner.hpp"

#include <doctest/doctest.h>

namespace septet::server {

constexpr double tick = 1.0 / 120.0;

TEST_CASE("a calm network keeps the delay of the rig") {
  PlayoutPlanner planner(2.0 * tick, tick);
  for (int i = 0; i < 600; ++i) {
    planner.observe(0.0005, 50.0 + i * tick);
    const auto header = planner.header(50.0 + i * tick, i * tick);
    CHECK(header.offset_s == doctest::Approx(50.0 + 2.0 * tick));
    CHECK(header.next_offset_s == doctest::Approx(50.0 + 2.0 * tick));
  }
}

TEST_CASE("a late tick lengthens the delay at an announced instant and a calm while shortens it again") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.0, 0.0);
  planner.observe(0.030, 1.0);
  const auto announced = planner.header(1.0, 1.0);
  CHECK(announced.offset_s == doctest::Approx(2.0 * tick));
  CHECK(announced.next_offset_s == doctest::Approx(0.030 + 1.5 * tick));
  CHECK(announced.next_from_s > 1.05);
  CHECK(planner.header(1.2, 1.2).offset_s == doctest::Approx(0.030 + 1.5 * tick));
  for (double now = 1.2; now < 8.0; now += tick) planner.header(now, now);
  CHECK(planner.header(8.0, 8.0).offset_s == doctest::Approx(2.0 * tick));
}

TEST_CASE("ticks published up to a millisecond late move nothing") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.001, 0.0);
  for (int i = 1; i < 600; ++i) {
    const double late_s = 0.001 * (i % 3) / 2.0;
    CHECK(planner.header(i * tick + late_s, i * tick).next_offset_s == doctest::Approx(2.0 * tick + 0.001));
  }
}

TEST_CASE("a simulation that has fallen behind is shown later from an announced instant on") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.0, 0.0);
  const auto announced = planner.header(1.05, 1.0);
  CHECK(announced.offset_s == doctest::Approx(2.0 * tick));
  CHECK(announced.next_offset_s == doctest::Approx(2.0 * tick + 0.05));
  CHECK(announced.next_from_s > announced.published_s);
}

TEST_CASE("an offset that could shrink by less than half a tick stays and one that could by more shrinks") {
  for (const double ticks : {0.4, 0.6}) {
    PlayoutPlanner planner(2.0 * tick, tick);
    planner.header(0.0, 0.0);
    const double late_s = 0.030, earlier_s = late_s - ticks * tick;
    for (double now = 0.5; now < 12.0; now += tick) {
      planner.observe(now < 1.0 ? late_s : earlier_s, now);
      planner.header(now, now);
    }
    const auto header = planner.header(12.0, 12.0);
    CHECK(header.offset_s == doctest::Approx((ticks < 0.5 ? late_s : earlier_s) + 1.5 * tick));
    CHECK(planner.delay_s() == doctest::Approx(header.offset_s));
  }
}

TEST_CASE("a change is announced a tenth of a second ahead and none is made before the last one holds") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.0, 0.0);
  planner.header(1.0, 1.0);
  planner.observe(0.030, 2.0);
  CHECK(planner.header(2.0, 2.0).next_from_s == doctest::Approx(2.1));
  planner.observe(0.060, 2.05);
  const auto before = planner.header(2.05, 2.05);
  CHECK(before.next_offset_s == doctest::Approx(0.030 + 1.5 * tick));
  CHECK(before.offset_s == doctest::Approx(2.0 * tick));
  const auto after = planner.header(2.11, 2.11);
  CHECK(after.offset_s == doctest::Approx(0.030 + 1.5 * tick));
  CHECK(after.next_offset_s == doctest::Approx(0.060 + 1.5 * tick));
}

TEST_CASE("the greatest value counts for as long as it is remembered and then the next greatest") {
  SlidingMaximum maximum(5.0);
  CHECK(maximum.at(0.0, -1.0) == -1.0);
  maximum.add(3.0, 0.0);
  maximum.add(1.0, 2.0);
  maximum.add(2.0, 3.0);
  CHECK(maximum.at(5.0, -1.0) == 3.0);
  CHECK(maximum.at(5.1, -1.0) == 2.0);
  CHECK(maximum.at(8.1, -1.0) == -1.0);
}

TEST_CASE("a hopeless screen does not stretch the delay without bound") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.5, 0.5);
  planner.observe(30.0, 1.0);
  planner.header(1.0, 1.0);
  CHECK(planner.header(2.0, 2.0).offset_s <= 0.2501);
}

}  // namespace septet::server
