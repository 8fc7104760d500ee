#pragma once
/// Rigid shards of glass: flight through the air (air_force.hpp), inelastic bounces with friction, rest.

#include "engine/effects/debris/debris_state.hpp"

namespace septet::debris {

/// True where a piece is down to one splinter of a material that flies on as shards.
bool is_shard(const Piece& piece);

/// The shard with a piece's mass and motion.
Shard shard_of(const Piece& piece);

/// Returns the number of shards removed because of a non-finite number.
int advance_shards(State& state, const ContactWorld& world, double step_s, EnergyLedger* ledger = nullptr);

}  // namespace septet::debris
