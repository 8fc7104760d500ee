#include <doctest/doctest.h>

#include "tests/sim-server/client_script.hpp"

namespace septet::server {

using enum ScriptStep;

TEST_CASE("ticks are differences to what all screens have and a screen that has lost it gets a whole one") {
  ClientScript rig;
  rig.connect_all();
  rig.play(script(end_of_pump, a, 0));
  const std::size_t whole = rig.host().last_tick_bytes();
  rig.play(says(a, control::TickArrived{.tick = 1}));
  CHECK(rig.host().last_tick_bytes() == whole);  // The other one has nothing yet.
  rig.play(says(b, control::TickArrived{.tick = 1}));
  const std::size_t difference = rig.host().last_tick_bytes();
  CHECK(difference < whole);
  rig.play(says(a, control::TickArrived{.tick = 3, .lost_baseline = true}));
  CHECK(rig.host().last_tick_bytes() >= whole);
  rig.play(says(a, control::TickArrived{.tick = 4}));
  rig.play(says(b, control::TickArrived{.tick = 4}));
  CHECK(rig.host().last_tick_bytes() < whole);
}

TEST_CASE("the time from the driver's controls to the picture is counted once for each tick that a screen shows") {
  ClientScript rig;
  rig.connect_all();
  const auto shows = [&](Tick tick) {
    rig.play(script(end_of_pump, a, 2));  // 20 ms pass, and a tick is sent.
    rig.play(says(a, control::Presented{.tick = tick}));
  };
  for (Tick tick = 1; tick <= 6; ++tick) shows(tick);
  const LatencyRecord& record = rig.host().screens().front().report_to_picture;
  const auto before = record.count();
  CHECK(before > 0);
  CHECK(record.quantile_ms(1.0) < 500.0);
  shows(6);
  shows(5);
  CHECK(record.count() == before);
}

}  // namespace septet::server
