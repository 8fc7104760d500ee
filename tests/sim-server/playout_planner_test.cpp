#include "sim-server/playout_planner.hpp"

#include <doctest/doctest.h>

namespace septet::server {

constexpr double tick = 1.0 / 120.0;

TEST_CASE("a calm network keeps the rig's delay") {
  PlayoutPlanner planner(2.0 * tick, tick);
  for (int i = 0; i < 600; ++i) {
    planner.observe(0.0005, i * tick);
    CHECK(planner.header(i * tick).playout_delay_s == doctest::Approx(2.0 * tick));
  }
}

TEST_CASE("a late tick lengthens the delay at an announced instant and a calm while shortens it again") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.header(0.0);
  planner.observe(0.030, 1.0);
  const auto announced = planner.header(1.0);
  CHECK(announced.playout_delay_s == doctest::Approx(2.0 * tick));
  CHECK(announced.next_playout_delay_s == doctest::Approx(0.030 + 1.5 * tick));
  CHECK(announced.next_from_s > 1.05);
  CHECK(planner.header(1.2).playout_delay_s == doctest::Approx(0.030 + 1.5 * tick));
  for (double now = 1.2; now < 8.0; now += tick) planner.header(now);
  CHECK(planner.header(8.0).playout_delay_s == doctest::Approx(2.0 * tick));
}

TEST_CASE("a hopeless screen does not stretch the delay without bound") {
  PlayoutPlanner planner(2.0 * tick, tick);
  planner.observe(30.0, 1.0);
  planner.header(1.0);
  CHECK(planner.header(2.0).playout_delay_s <= 0.2501f);
}

}  // namespace septet::server
