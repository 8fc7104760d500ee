#pragma once
/// The storyboard as a stage of the tick: carries out its requests to traffic and the effects.

#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"
#include "engine/world/call.hpp"

namespace septet::simulation {

/// Advances the storyboard by one tick, with the driver's car where it is now. Events are appended.
void advance_storyboard(const Model& model, const DrivenCar& car, State& state, std::vector<Event>& events);

/// Carries out the requests of the storyboard, or of an operator who triggers a part of it. Events are appended.
void carry_out(const Model& model, const scenario::StepResult& step, const Participant& car, State& state,
               std::vector<Event>& events);

/// The event by which all who listen hear a call.
Event event_of(const Call& call);

/// A swarm's parameters in the traffic engine's terms.
traffic::TrafficParameters swarm_parameters(const scenario::TrafficSwarmAction& swarm);

/// Starts and ends the swarms requested by the storyboard.
void apply_swarms(const Model& model, const scenario::StepResult& step, const Participant& car, State& state);

/// Sets the rates at which people err, and has somebody overlooked, as requested by the storyboard. What this traffic
/// cannot do is told by an event.
void apply_errors(const Model& model, const scenario::StepResult& step, State& state, std::vector<Event>& events);

/// Tells of hazards that begin (engine/world/hazard.hpp).
void tell_hazards(const scenario::StepResult& step, const Model& model, const State& state, std::vector<Event>& events);

/// Spills, ignites and puts out as requested by the storyboard.
void apply_effects(const Model& model, const scenario::StepResult& step, const Participant& car, State& state);

/// Vehicles that traffic has to yield to and does not move itself; the driver's car comes first.
std::vector<traffic::ForeignVehicle> foreign_vehicles(const Model& model, const State& state, const Participant& car);

}  // namespace septet::simulation
