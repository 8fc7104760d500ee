#pragma once
/// Simplifications of the published multi-body equations that no real car has: only for cars that are read
/// `as_published`, to verify the rest of the chassis against them (vehicles/README.md). Source: vehicle_dynamics_mb of
/// CommonRoad vehicle models 3.0.2 (M. Althoff and G. Würsching 2020).
///
/// Body's axes, moments about the centre of the sprung mass. `up` is the vertical there, unit length.

#include <array>

#include "engine/physics/vehicle/equations_of_motion.hpp"
#include "engine/physics/vehicle/suspension.hpp"

namespace septet::vehicle {

/// The car's heading on a ground with this normal: forward along the body, level.
inline Vec3 level_forward(const Vec3& normal) { return glm::normalize(Vec3(1.0, 0.0, 0.0) - normal.x * normal); }

/// Velocity of one wheel's contact over the ground, along the wheel's heading and to its left: the sideways and forward
/// velocity of the sprung mass, yaw about the vertical, and the rolling of the axle. Left out are the motion of the
/// wheels forward or back with a pitching body, and its turn about its roll axis by yaw. `height_m`: of the wheel's
/// centre.
Vec2 published_contact_velocity_mps(const VehicleParameters& parameters, const Statics& known, int wheel,
                                    const VehicleState& state, const Vec3& velocity_mps, const Vec3& normal,
                                    double height_m);

/// Inclination of a wheel's spin axis against the ground, steer not counted: a steered wheel does not lean with a
/// pitched body.
double published_inclination_rad(const Vec3& spin_axis, const Vec3& normal);

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
