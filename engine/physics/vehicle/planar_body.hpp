#pragma once
/// The car as a rigid body in plan, for impacts (engine/physics/impact): there and back.

#include "engine/physics/impact/body.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

/// Mass and yaw inertia are those of the vehicle's file; its heading counts as 0.
impact::Body planar_body(const BodyParameters& body, const VehicleState& state);

/// Takes over what an impact has changed within `dt_s` from `before` to `after`: place, heading, motion, accelerations.
void take_over(const impact::Body& before, const impact::Body& after, double dt_s, VehicleState& state);

}  // namespace septet::vehicle
