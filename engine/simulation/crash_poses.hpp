#pragma once
/// Open crashes by what the tick's snapshot will show of their two, so that a reader of snapshots finds the same.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Notes the motion with which the tick leaves both of each crash that was pushed in it, all other pushes included, and
/// how deep their outlines have come into each other; somebody who is thrown has none. Call it when nothing moves `participants` (ascending id) any more
/// in this tick.
void note_poses(const Model& model, const std::vector<Participant>& participants, State& state);

}  // namespace septet::simulation
