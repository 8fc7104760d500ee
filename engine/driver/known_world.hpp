#pragma once
/// Those around a driver of whom he knows: seen now (engine/world/seen_participants.hpp), heard by a siren near by, or seen
/// shortly before and now hidden, who are taken to have gone on evenly, round the bend that they were in.
///
/// World frame.

#include <vector>

#include "engine/world/snapshot.hpp"

namespace septet::driver {

/// A siren is heard so far in a closed car: 30 to 50 m at best, at 8 to 12 dB over the noise within it (review of warning
/// systems of emergency vehicles, National Academies of Emergency Dispatch, read as an excerpt). What stands between does
/// not matter; from where it comes is taken to be known.
inline constexpr double siren_heard_m = 50.0;

struct KnownWorld {
  std::vector<Participant> bodies;  ///< With the driver's own, ascending.
  std::vector<double> unseen_s;     ///< Of each: since he was last seen or heard.
};

/// A look, `dt_s` after the last one. A snapshot that does not tell who is seen hides nobody.
void look_around(KnownWorld& known, const Snapshot& snapshot, double dt_s);

}  // namespace septet::driver
