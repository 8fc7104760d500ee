#pragma once
/// Contact of the body itself with the ground: a roll-over, a kerb, a ditch. A penalty at the eight corners of its box;
/// crude, but no car falls through the road. The force is bounded, and a car found deep in the ground is lifted out
/// slowly.

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

/// Adds force and moment about the centre of the sprung mass, in the body's axes. `velocity_mps` is that of the centre.
void add_body_contact(const VehicleParameters& parameters, const Ground& ground, const VehicleState& state,
                      const Vec3& velocity_mps, Vec3& force_n, Vec3& moment_nm);

}  // namespace septet::vehicle
