#pragma once
/// The broad phase of collisions: pairs that may touch.

#include <cstddef>
#include <utility>
#include <vector>

#include "engine/world/snapshot.hpp"

namespace septet::simulation {

/// Pairs of indices into `participants`, the lesser first, ascending, whose circles overlap in plan and of which one is
/// below `first_engine`, or among `loose` (ascending): those of one traffic engine are left to it. Cost: one look per
/// participant, and one per pair that is near along x.
std::vector<std::pair<std::size_t, std::size_t>> near_pairs(const std::vector<Participant>& participants,
                                                            ParticipantId first_engine,
                                                            const std::vector<ParticipantId>& loose);

}  // namespace septet::simulation
