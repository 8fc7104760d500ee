#pragma once
/// Smoke and its keyframes to bytes and back (engine/core/archive.hpp).

#include "engine/core/archive.hpp"
#include "engine/effects/smoke/smoke_keyframe.hpp"
#include "engine/effects/smoke/smoke_state.hpp"

namespace septet::smoke {

void save_smoke(const State& state, const KeyframeTrack& track, StateWriter& writer);

/// `reader` fails on invalid data: then both are not to be used.
void restore_smoke(StateReader& reader, State& state, KeyframeTrack& track);

}  // namespace septet::smoke
