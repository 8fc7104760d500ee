#pragma once
/// Controls to chassis inputs: steering column, engine and gearbox, brakes. One step each; all read the state of the
/// last step and change only their own part of it.

#include "engine/physics/vehicle/vehicle.hpp"

namespace septet::vehicle {

/// Advances the steering column and returns the mean road-wheel angle. Also sets the driver's steering torque.
double advance_steering(const VehicleParameters& parameters, double steering_wheel_rad, double speed_mps, double dt_s,
                        VehicleState& state);

/// Engine, converter or clutch, gearbox and differential: torque at each wheel, N m.
std::array<double, wheel_count> advance_powertrain(const VehicleParameters& parameters, const DriverInput& input,
                                                   double speed_mps, double dt_s, VehicleState& state);

/// Speed of the gearbox's output shaft before the final drive, rad/s, from the driven wheels.
double output_shaft_radps(const VehicleParameters& parameters, const VehicleState& state);

/// The automatic's gear at a steady speed with little throttle.
int cruising_gear(const PowertrainParameters& powertrain, double output_radps);

/// Pedal, parking brake, anti-lock, traction and stability control: friction torque at each wheel, N m.
std::array<double, wheel_count> advance_brakes(const VehicleParameters& parameters, const DriverInput& input,
                                               const Vec3& velocity_mps, double dt_s, VehicleState& state);

}  // namespace septet::vehicle
