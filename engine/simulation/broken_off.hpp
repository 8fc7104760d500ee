#pragma once
/// Parts that a crash breaks off: what the vehicles that have lost them get of it.

#include <vector>

#include "engine/simulation/crash_recording.hpp"

namespace septet::simulation {

/// Gives loose bodies the impulse that the pieces have left them, and records it for both; `participants` (ascending
/// id) are then as they stand. `own`: the driver's car, which has been given its own already. Who stays on the rails
/// keeps his motion.
void give_back(const BrokenOff& broken, const PushedByPieces& own, std::vector<Participant>& participants,
               State& state);

}  // namespace septet::simulation
