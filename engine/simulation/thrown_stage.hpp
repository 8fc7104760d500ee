#pragma once
/// People, cyclists and motorcyclists whom the driver's car hits are thrown (engine/physics/person).
///
/// From the touch on such a participant is a body of State::thrown: it has left its script, flies, slides and lies, and
/// stays there. A rider leaves the machine and is a participant of his own, with an id from first_rider_participant on.
/// The car loses what bodies get, along its motion and not about it. Other vehicles push bodies and lose nothing. What a
/// traffic engine does not give up goes on in its lane, unseen; for the other drivers its place is still taken.

#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Rider of the machine with id n: this and n.
inline constexpr ParticipantId first_rider_participant = 8192;

bool is_thrown(const State& state, ParticipantId id);

/// True where this stage decides on what happens between the car and `other`: it was thrown, or will be at the touch.
bool is_for_thrown_stage(const State& state, const Participant& car, const Participant& other);

/// Puts thrown bodies in the places of the participants that they were, and adds riders.
void show_thrown(const State& state, std::vector<Participant>& participants);

/// Begins bodies with whom the car meets in this tick, and advances all. `participants`: of this tick, ascending id.
void advance_thrown(const Model& model, DrivenCar& car, std::vector<Participant>& participants, State& state,
                    std::vector<Event>& events);

}  // namespace septet::simulation
