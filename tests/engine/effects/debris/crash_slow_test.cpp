#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/effects/debris/contacts.hpp"
#include "engine/physics/elastic/body_measures.hpp"
#include "tests/engine/effects/debris/crashes.hpp"
#include "tests/engine/effects/debris/pieces.hpp"

using namespace septet;
using namespace septet::debris;

TEST_CASE("debris of a crash lies in the way and none of it in the barrier") {
  State state;
  Random random(3);
  Crash crash = into_barrier(crash_speed_mps);
  debris::crash(state, crash, level_road(), random);
  ContactWorld world = level_road();
  crash.first.box.velocity_mps = Vec3(0);
  world.boxes = {crash.first.box, crash.second.box};
  double widest = 0.0;
  for (int k = 0; k < 90; ++k) advance_debris(state, world, 1.0 / 60);
  for (const Piece& p : state.pieces) {
    const auto centre = elastic::centre_of_mass_m(p.body);
    CHECK(centre.z() > -0.05);
    CHECK(centre.allFinite());
    for (const Box& box : world.boxes) CHECK(gap_to_box(box, from_eigen(centre)).gap_m > -0.05);
    widest = std::max(widest, std::abs(centre.y()));
  }
  CHECK(widest > 2.0);   // Beyond the car's own lane half,
  CHECK(widest < 40.0);  // and within its energy.
  CHECK(state.bad_numbers == 0);
}
