#pragma once
/// Loose bodies as a stage of the tick: they leave their rails at their first contact, slide on locked wheels, turn,
/// rest, and stay where they are as obstacles.
///
/// Who has left the rails is moved by nobody else: the storyboard's running actions on it are stopped and later ones
/// wait, the traffic engine has given it up. Traffic meets it as a vehicle of others, everybody else as the same
/// participant.

#include <optional>
#include <vector>

#include "engine/physics/impact/meet.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// The loose body of a participant; null where it is none.
const LooseBody* find_loose(const State& state, ParticipantId id);
LooseBody* find_loose(State& state, ParticipantId id);

/// As in loose_body.hpp; of a solid, the one that it was given.
double mass_kg(const Model& model, const State& state, const Participant& participant);

/// Motion in plan of one whom contacts push: the driver's car, or a loose body; empty for others.
std::optional<impact::Body> pushed_body(const Model& model, const State& state, ParticipantId id);

/// Storyboard or traffic engine moves the participant no more. False, and nothing has changed: its engine keeps it.
/// Events are appended.
bool give_up_rails(const Model& model, ParticipantId id, const Participant& car, State& state,
                   std::vector<Event>& events);

/// True for vehicles on four wheels and for boxes; false for a box that is moved by its script and has no mass by which
/// it could be pushed.
bool may_leave_rails(const Model& model, const Participant& participant);

/// Takes it off its rails as it moves now. False, and nothing has changed: it may not leave them, or its traffic engine
/// keeps it. Events are appended.
bool leave_rails(const Model& model, const Participant& participant, const Participant& car, State& state,
                 std::vector<Event>& events);

/// Moves all by their wheels for a tick, against what stands beside the road (loose_hull.hpp); solids in motion by that
/// (solid_motion.hpp). Contacts push them afterwards (collisions.hpp). Events are appended.
void advance_bodies(const Model& model, State& state, std::vector<Event>& events);

/// Tells the storyboard where those are that were its own.
void place_in_storyboard(const Model& model, State& state);

/// Adds all, in the order in which they left their rails.
void append_bodies(const State& state, std::vector<Participant>& participants);

/// Adds all but the driver's car, as they move now: the scenario's, traffic's, and those that left their rails.
void append_others(const Model& model, const State& state, std::vector<Participant>& participants);

/// Drops those that came from traffic: their swarm ends, and another may use their numbers.
void drop_traffic_bodies(State& state);

/// What running contacts, but for `besides`, will still change of a participant's motion, as `body` has it.
impact::Due due_of_contacts(const State& state, ParticipantId id, const impact::Body& body,
                            const BodyContact* besides = nullptr);

}  // namespace septet::simulation
