#pragma once
/// Impacts of the driver's car with people, two-wheelers and whatever else stays on its rails (bodies/loose_body.hpp),
/// by the law of all impacts (engine/physics/impact): the impulse of the closed form with restitution and friction,
/// spread over the crush in the car's own steps.
///
/// Their mass and inertia count, and their share of the impulse is kept beside the pulse, but they move on as they
/// were. So a pulse is begun with the touch, and none again while the two overlap.

#include <optional>

#include "engine/physics/impact/meet.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Begins the impact of two that overlap since this tick; empty where they do not approach. `car`: the driver's car as
/// it stands in `state`.
std::optional<impact::Impact> begin_impact(const Model& model, const Participant& car, const Participant& other,
                                           State& state);

/// What running impacts with others, contacts of bodies included, will still change of the car's motion.
impact::Due due_to_car(const State& state, const impact::Body& body);

/// Gives the car what is due of its impacts in a step that it has just made. Impacts that are over are forgotten.
void advance_impacts(const Model& model, double dt_s, State& state);

}  // namespace septet::simulation
