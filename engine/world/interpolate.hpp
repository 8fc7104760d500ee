#pragma once
/// The world between two snapshots, for a screen's times between ticks.
///
/// Positions follow the quintic that meets position, velocity and acceleration of both snapshots; orientations turn by
/// the spherical interpolation whose angle varies quadratically (spherical_interpolation.hpp), with σ from the two
/// angular velocities, and wheels by the same law with σ from their two spin rates. A participant in only one of the
/// two snapshots is shown at its place in that one; one that was moved by more than its motion explains (a teleport) is
/// not smeared across the gap. Pure functions.

#include "engine/world/snapshot.hpp"

namespace septet {

/// The snapshot at `time_s`, within [before, after] (clamped). Lamps, the driver's car, effects and environment are
/// those of `before` until `after` is reached. The result carries the tick and time of `before`'s interval start and
/// the given time.
Snapshot interpolate(const Snapshot& before, const Snapshot& after, double time_s);

/// One participant; `seconds` is the interval's length, `t` in [0, 1] the place in it.
Participant interpolate(const Participant& before, const Participant& after, double seconds, double t);

}  // namespace septet
