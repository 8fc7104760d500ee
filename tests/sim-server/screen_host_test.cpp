#include <doctest/doctest.h>

#include "tests/sim-server/client_script.hpp"

namespace septet::server {
namespace {

using enum ScriptStep;

template <class... Parts>
Bytes script(Parts... parts) {
  return {static_cast<std::byte>(parts)...};
}

/// That the client sends this message and the host reads it and publishes a tick.
void says(ClientScript& rig, int client, const control::ControlMessage& message) {
  const Bytes bytes = control::encode_control(message);
  Bytes steps = script(ScriptStep::control, client, bytes.size() - 1);
  steps.insert(steps.end(), bytes.begin() + 1, bytes.end());
  for (const std::byte part : script(pump, client, end_of_pump, client, 0)) steps.push_back(part);
  rig.play(steps);
}

constexpr int a = 0, b = 1;

}  // namespace

TEST_CASE("ticks are differences to what all screens have and a screen that has lost it gets a whole one") {
  ClientScript rig;
  rig.connect_all();
  rig.play(script(end_of_pump, a, 0));
  const std::size_t whole = rig.host().last_tick_bytes();
  says(rig, a, control::TickArrived{.tick = 1});
  CHECK(rig.host().last_tick_bytes() == whole);  // The other one has nothing yet.
  says(rig, b, control::TickArrived{.tick = 1});
  const std::size_t difference = rig.host().last_tick_bytes();
  CHECK(difference < whole);
  says(rig, a, control::TickArrived{.tick = 3, .lost_baseline = true});
  CHECK(rig.host().last_tick_bytes() >= whole);
  says(rig, a, control::TickArrived{.tick = 4});
  says(rig, b, control::TickArrived{.tick = 4});
  CHECK(rig.host().last_tick_bytes() < whole);
}

TEST_CASE("the time from the driver's controls to the picture is counted once for each tick that a screen shows") {
  ClientScript rig;
  rig.connect_all();
  const auto shows = [&](Tick tick) {
    rig.play(script(end_of_pump, a, 2));  // 20 ms pass, and a tick is sent.
    says(rig, a, control::Presented{.tick = tick});
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
