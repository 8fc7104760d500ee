#pragma once
/// A crash site where the driver's car alone meets solids.

#include <doctest/doctest.h>

#include "engine/simulation/bodies/bodies.hpp"
#include "engine/simulation/solids.hpp"
#include "tests/engine/simulation/crash_site.hpp"
#include "tests/why_not.hpp"

namespace septet::simulation {

/// The driver's car, at the origin, drives along x; nobody else is there.
inline CrashSite alone(double speed_mps) { return {plane_model(0), {}, speed_mps, {}}; }

inline void stand_in(const StandSolid& solid, CrashSite& site) {
  const auto done = stand_solid(site.model, solid, site.state);
  REQUIRE_MESSAGE(done.has_value(), why_not(done));
  site.participants.resize(1);
  append_bodies(site.state, site.participants);
}

inline void pass(CrashSite& site, double time_s) {
  for (int i = 0; i < static_cast<int>(time_s * tick_rate_hz); ++i) site.tick();
}

}  // namespace septet::simulation
