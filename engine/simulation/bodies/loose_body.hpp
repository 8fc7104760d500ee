#pragma once
/// A vehicle or a scenario's box as a loose body: from a participant, and back to one.

#include "engine/physics/impact/meet.hpp"
#include "engine/physics/vehicle/sliding.hpp"
#include "engine/simulation/bodies/bodies_state.hpp"
#include "engine/simulation/model.hpp"

namespace septet::simulation {

/// One mass a participant: of the driver's car its vehicle file's, of others that of the scenario where it gives one,
/// else that of their kind (engine/world/bodies.toml). Of a box as in scenario/model/misc_object.hpp: infinite, where it
/// stands fast, and of a solid, whose own its body has (bodies.hpp).
double mass_kg(const Model& model, const Participant& participant);

/// Its mass centre ahead of its origin: of the driver's car as its file has it, of others the middle of the outline.
double mass_centre_ahead_m(const Model& model, const Participant& participant);

/// A participant as a body that can be hit: its outline in plan, and the yaw inertia of an even box of its size.
impact::Side impact_side(const Participant& participant, double mass_kg);

/// The participant as it leaves its rails.
LooseBody loose_body(const Participant& participant, double mass_kg);
/// The body as a participant: brake lamps lit, wheels locked, if it has any.
Participant participant_of(const LooseBody& loose);
/// The body with its whole outline.
impact::Side side_of(const LooseBody& loose);

/// Takes over an impulse at its mass centre that it was given within a tick, as far as it is level.
void push(const Vec3& impulse_ns, LooseBody& loose);

/// Where it stands on the ground, seen from its origin: its wheels, front ones first, left ones first; near the corners
/// of a box.
std::array<Vec3, vehicle::wheel_count> feet_m(const LooseBody& loose);

/// These as they slide; `friction` as their ground's peak.
vehicle::LockedWheels locked_wheels(const LooseBody& loose, const std::array<double, vehicle::wheel_count>& friction);

}  // namespace septet::simulation
