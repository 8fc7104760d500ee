#pragma once
/// Accelerations of body and wheel hops under given forces.
///
/// Coordinates: the body's velocity in its own axes (x, y, z), its roll and pitch rates, and the four rates of travel.
/// With J_i the row that takes them to the velocity of wheel centre i, the kinetic energy has the matrix M =
/// diag(sprung mass, inertia) + Σ m_i J_iᵀ J_i, and M · acceleration = generalised force (Lagrange; Roberson and
/// Schwertassek 1988, chapter 5). Yaw stands beside it: its inertia is given for the whole car, and the centres of the
/// sprung mass and of the whole car are taken to coincide in plan. Gravity accelerates all masses alike and is left
/// out: linear accelerations here are those of an accelerometer.

#include <array>

#include "engine/physics/vehicle/suspension.hpp"

namespace septet::vehicle {

inline constexpr int coordinate_count = 9;  ///< x, y, z, roll, pitch, four travels.
using Coordinates = std::array<double, coordinate_count>;

/// Velocity of wheel centre `wheel` per unit of each coordinate; rows x, y, z.
std::array<Coordinates, 3> centre_jacobian(const WheelPlace& place, int wheel);

/// Solves M · acceleration = force.
Coordinates accelerations(const VehicleParameters& parameters, const Statics& statics,
                          const std::array<WheelPlace, wheel_count>& places, const Coordinates& force);

}  // namespace septet::vehicle
