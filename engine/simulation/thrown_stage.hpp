#pragma once
/// People, cyclists and motorcyclists whom a vehicle hits are thrown (engine/physics/person).
///
/// From the touch on such a participant is a body of State::thrown: it has left its script, flies, slides and lies, and
/// stays there. A rider leaves the machine and is a participant of his own, with a number by engine/world/rider.hpp.
/// The driver's car and loose bodies lose what bodies get, along their motion and not about it; who was on rails leaves
/// them at the touch, as after any crash (bodies/bodies.hpp). Who cannot leave them pushes bodies and loses nothing. What
/// a traffic engine does not give up goes on in its lane, unseen; for the other drivers its place is still taken. Pairs
/// of one traffic engine are left to it, and two who can both be thrown only touch.

#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"
#include "engine/world/rider.hpp"

namespace septet::simulation {

bool is_thrown(const State& state, ParticipantId id);

/// True where this stage decides on what happens between the two: one was thrown, or will be at the touch.
bool is_for_thrown_stage(const State& state, const Participant& first, const Participant& second);

/// Puts thrown bodies in the places of the participants that they were, and adds riders.
void show_thrown(const State& state, std::vector<Participant>& participants);

/// Begins bodies with whom a vehicle meets in this tick, and advances all. `participants`: of this tick, ascending id.
void advance_thrown(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
                    std::vector<Event>& events);

}  // namespace septet::simulation
