#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "engine/world/limbs.hpp"
#include "tests/engine/scenario/scenario_text.hpp"
#include "tests/relative.hpp"

namespace septet::scenario {

TEST_CASE("who walks faster makes more steps and longer ones, and none is cut short") {
  Drive drive(scenario_text(private_text("A", place_text(-2, 100) + speed_text(0.8)),
                            story_text(event_text("faster", speed_text(2.0, "linear", "time", 4.0), at_time(5.0)))));
  drive.scenario.entities[0].kind = EntityKind::pedestrian;
  drive.scenario.entities[0].model = *find_vehicle_model("pedestrian");
  double before = 0.0, strides = 0.0, slow = 0.0, fast = 0.0;
  for (int step = 1; step <= 1400; ++step) {
    drive.run_until(0.01 * step);
    std::vector<Participant> participants;
    append_participants(drive.scenario, drive.state, 1, participants);
    REQUIRE_FALSE(participants.empty());
    const double now = participants.front().wheel_spin_rad / (2.0 * std::numbers::pi);
    double made = now - before;
    if (made < 0.0) made += 1.0;
    CHECK(made < 0.01 * strides_hz(2.0) + 1e-6);
    strides += made, before = now;
    CHECK(participants.front().wheel_spin_radps / (2.0 * std::numbers::pi) ==
          relative(strides_hz(drive.a().speed_mps), 1e-9));
    if (step == 500) slow = strides;
    if (step == 1000) fast = strides;
  }
  CHECK(slow == relative(5.0 * strides_hz(0.8), 0.01));
  CHECK(strides - fast == relative(4.0 * strides_hz(2.0), 0.01));
}

}  // namespace septet::scenario
