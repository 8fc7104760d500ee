#pragma once
/// Debris to bytes and back (engine/core/archive.hpp).

#include "engine/core/archive.hpp"
#include "engine/effects/debris/debris_state.hpp"
#include "engine/effects/debris/mounted_part.hpp"
#include "engine/math/transform_members.hpp"

namespace septet::debris {

SEPTET_MEMBERS(PieceOrigin, vehicle, model, paint, mount)
// Its mount follows from its place.
SEPTET_MEMBER_GROUPS(MountedPart, hashed(part, box_from_part, mount_strength_n), kept(mount))

void save_debris(const State& state, StateWriter& writer);
/// Adds the moving part of the state: to be chained from step to step.
void add_to_hash(const State& state, StateHash& hash);

/// `reader` fails on invalid data: then `state` is not to be used.
void restore_debris(StateReader& reader, State& state);

}  // namespace septet::debris
