#pragma once
/// Collisions of the driver's car with other participants.

#include <vector>

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Finds the participants that overlap `car`, as boxes with the corners of vehicles. A touch that begins is counted and
/// logged as an event. Where the surfaces approach, its impact begins (car_impacts.hpp), and its parts and dents are for
/// the effects' next step (advance_crashes). Call it once all participants have moved, before the snapshot is taken: its
/// hash holds the result.
void find_collisions(const Model& model, const Participant& car, const std::vector<Participant>& participants,
                     State& state, std::vector<Event>& events);

}  // namespace septet::simulation
