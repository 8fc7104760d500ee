#pragma once
/// Impacts of the driver's car with other vehicles, by the law of all impacts (engine/physics/impact): the impulse of
/// the closed form with restitution and friction, spread over the crush in the car's own steps.
///
/// Others are moved by traffic or by the storyboard; their mass and inertia count, and their share of the impulse is
/// kept beside the pulse, but they drive on as they were. So a pulse is begun with the touch, and none again while the
/// two overlap.

#include <optional>

#include "engine/physics/impact/meet.hpp"
#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// One mass a participant: of the driver's car its vehicle file's, of others that of the scenario where it gives one,
/// else that of their kind (engine/world/bodies.toml).
double mass_kg(const Model& model, const Participant& participant);

/// A participant as a body that can be hit: its outline in plan, and the yaw inertia of an even box of its size.
impact::Side impact_side(const Participant& participant, double mass_kg);

/// Begins the impact of two that overlap since this tick; empty where they do not approach. `car`: the driver's car as
/// it stands in `state`.
std::optional<impact::Impact> begin_impact(const Model& model, const Participant& car, const Participant& other,
                                           State& state);

/// What running impacts with vehicles will still change of the car's motion.
impact::Due due_to_car(const State& state, const impact::Body& body);

/// Gives the car what is due of its impacts in a step that it has just made. Impacts that are over are forgotten.
void advance_impacts(const Model& model, double dt_s, State& state);

}  // namespace septet::simulation
