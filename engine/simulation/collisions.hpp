#pragma once
/// Whom the driver's car touches.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Finds who of `participants` overlaps `car`, as boxes. A touch that begins is counted, told of, and met by the effects' next step
/// (advance_crashes). Call it when everybody has moved, before the snapshot is taken: its hash holds what was found.
void find_collisions(const Participant& car, const std::vector<Participant>& participants, State& state,
                     std::vector<Event>& events);

}  // namespace septet::simulation
