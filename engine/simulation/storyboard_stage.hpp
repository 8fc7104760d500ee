#pragma once
/// The storyboard as a stage of the tick: what it asks of traffic and of the effects is done here.

#include <vector>

#include "engine/simulation/driver_car.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// One tick of the storyboard, with the driver's car where it is now. Events are appended.
void advance_storyboard(const Model& model, const DrivenCar& car, State& state, std::vector<Event>& events);

/// What the storyboard, or who triggers a part of it, has asked of others. Events are appended.
void carry_out(const Model& model, const scenario::StepResult& step, const Participant& car, State& state,
               std::vector<Event>& events);

/// A swarm's traffic as an engine is asked for it.
traffic::TrafficParameters swarm_parameters(const scenario::TrafficSwarmAction& swarm);

/// Starts and ends the swarms that the storyboard asked for.
void apply_swarms(const Model& model, const scenario::StepResult& step, const Participant& car, State& state);

/// Spills, ignites and puts out what the storyboard asked for.
void apply_effects(const Model& model, const scenario::StepResult& step, const Participant& car, State& state);

/// Everybody whom traffic has to mind and does not move itself; the driver's car comes first.
std::vector<traffic::ForeignVehicle> foreign_vehicles(const Model& model, const State& state, const Participant& car);

}  // namespace septet::simulation
