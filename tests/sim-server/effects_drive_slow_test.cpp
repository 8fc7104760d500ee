#include <doctest/doctest.h>

#include "engine/effects/debris/debris_keyframe.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/net/tick_publisher.hpp"
#include "engine/simulation/server_step.hpp"
#include "engine/world/wire_snapshot.hpp"
#include "tests/sim-server/shipped_drive.hpp"

using namespace septet;
using namespace septet::server;

namespace {

struct Driven {
  std::vector<std::uint64_t> hashes;
  Snapshot last;
  std::size_t debris = 0, smoke = 0;  ///< Keyframes in the last snapshot.
  std::vector<std::string> warnings;
};

/// Drives straight on for some seconds, then brakes: enough for the scenario's effects.
Driven drive(const std::string& name, double seconds, std::uint64_t seed) {
  const LoadedDrive loaded = shipped_drive(name, "seven-screens", seed);
  auto state = simulation::initial_state(*loaded.model, traffic::own_traffic(loaded.model->roads, 1));
  REQUIRE(state);
  Driven driven;
  driven.warnings = loaded.warnings;
  std::vector<simulation::Event> events;
  DriverInput input;
  for (int tick = 0; tick < static_cast<int>(seconds * simulation::tick_rate_hz); ++tick) {
    input.accelerator = tick < 600 ? 0.3 : 0.0;
    input.brake = tick < 600 ? 0.0 : 0.3;
    driven.last = simulation::server_step(*loaded.model, input, *state, events);
    driven.hashes.push_back(driven.last.state_hash);
  }
  for (const EffectKeyframe& keyframe : driven.last.effects) {
    if (keyframe.kind == debris::keyframe_kind) ++driven.debris;
    if (keyframe.kind == smoke::keyframe_kind) ++driven.smoke;
  }
  return driven;
}

void check_that_a_late_screen_gets_all(const Snapshot& snapshot) {
  Bytes keyframe;
  encode_snapshot(to_wire(snapshot), nullptr, keyframe);
  CHECK(keyframe.size() < net::max_tick_bytes);
  const auto joined = decode_snapshot(keyframe, nullptr);
  REQUIRE(joined);
  CHECK(joined->rest.effects == snapshot.effects);
}

}  // namespace

TEST_CASE("in winter-lorry ice breaks on the road and the same seed breaks it in the same way") {
  const Driven first = drive("winter-lorry", 9.0, 1), second = drive("winter-lorry", 9.0, 1);
  CHECK(first.warnings.empty());
  CHECK(first.debris > 12);  // Seven cones, a post, and more pieces than slabs.
  CHECK(first.hashes == second.hashes);
  check_that_a_late_screen_gets_all(first.last);
}

TEST_CASE("in tunnel-fire smoke spreads and the same seed gives the same smoke") {
  const Driven first = drive("tunnel-fire", 12.0, 1), second = drive("tunnel-fire", 12.0, 1);
  CHECK(first.warnings.empty());
  CHECK(first.smoke > 2);
  CHECK(first.hashes == second.hashes);
  check_that_a_late_screen_gets_all(first.last);
}
