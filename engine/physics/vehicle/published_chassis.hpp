#pragma once
/// Simplifications of the published multi-body equations that no real car has: only for cars that are read
/// `as_published`, to verify the rest of the chassis against them (vehicles/README.md). Source: vehicle_dynamics_mb of
/// CommonRoad vehicle models 3.0.2 (M. Althoff and G. Würsching 2020).
///
/// Body's axes, moments about the centre of the sprung mass. `up` is the vertical there, unit length.

#include <array>

#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/tyre.hpp"

namespace septet::vehicle {

/// The place of which a wheel's height over the ground is taken: the published height of an axle leaves out that its
/// centre moves sideways under a leaning body.
Vec3 published_measured_m(const VehicleParameters& parameters, int wheel, const Vec3& centre_m);

/// Heading of a wheel along the ground: the steer angle's alone, although a wheel that leans on a pitched body turns by
/// that.
Vec3 published_heading(double steer_rad, const Vec3& normal);

/// Puts the published motion and inclination into a contact whose rolling speed is set.
void publish_contact(const VehicleParameters& parameters, const Statics& known, int wheel, const VehicleState& state,
                     const Vec3& velocity_mps, const Vec3& spin_axis, const Vec3& normal, double height_m,
                     TyreContact& contact);

/// Yaw moment of one wheel's force: the wheels stand as on an upright car, although a leaning body carries its mass
/// centre sideways over them, and braking forces turn it about that centre.
double published_yaw_moment_nm(const VehicleParameters& parameters, const Statics& known, int wheel, const Vec3& up,
                               const Vec3& tyre_n);

/// Yaw acceleration about the body's axis: the moment turns the heading; pitch or roll of a body about its leaning axes
/// do not.
double published_yaw_acceleration(double yaw_radps2, const Vec3& up, const Vec3& omega_radps, double pitch_radps2);

/// The springs push along the leaning body, and their sideways part meets the axle at the height of its wheels' centres
/// instead of the joint: that holds the axle upright while the body leans away.
void add_upright_axles(const VehicleParameters& parameters, const std::array<double, wheel_count>& spring_n,
                       const VehicleState& state, Coordinates& generalised);

/// Force that yaws the unsprung masses around the centre of the sprung mass. Published without its counterpart in yaw;
/// our own cars take the centres to coincide in plan, so that it vanishes.
void add_yawing_axles(const VehicleParameters& parameters, const std::array<WheelPlace, wheel_count>& places,
                      double yaw_radps2, Coordinates& generalised);

/// The wheels' longitudinal forces pitch the body with their full height under its mass centre, as if the axles and the
/// wheels' spin took no part of them.
void add_weightless_axles(const VehicleParameters& parameters, const std::array<WheelPlace, wheel_count>& places,
                          const Vec3& up, const Vec3& force_n, Coordinates& generalised);

}  // namespace septet::vehicle
