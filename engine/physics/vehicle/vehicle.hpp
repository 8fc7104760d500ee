#pragma once
/// The driver's car: a double-track model with fourteen degrees of freedom (6 of the body, 4 wheel
/// hops, 4 wheel spins).
///
///     VehicleState car = standstill(parameters, world_from_vehicle);
///     for (int i = 0; i < 10; ++i) advance_vehicle(parameters, input, ground, 0.001, car);
///     VehicleOutputs shown = outputs(parameters, car);
///
/// All functions are pure: same arguments, same bits, on every machine whose compiler does not
/// contract to fused multiply-add. Different cars may be advanced by different threads.

#include <array>

#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"
#include "engine/world/driver_input.hpp"

namespace septet::vehicle {

/// Longest step for which the wheels' spin and hop are stable.
inline constexpr double longest_step_s = 0.002;

/// The car at rest on its springs, or rolling straight ahead (backwards if negative) with wheels, gear and engine to
/// match. `world_from_vehicle` has its z axis along the ground's normal.
VehicleState standstill(const VehicleParameters& parameters, const RigidTransform& world_from_vehicle,
                        double speed_mps = 0.0);

/// Advances the car by `dt_s` (0.001 is meant; at most longest_step_s). A step that would yield a non-finite number is
/// undone and counted in state.bad_numbers: the car then stands still where it was.
void advance_vehicle(const VehicleParameters& parameters, const DriverInput& input, const Ground& ground, double dt_s,
                     VehicleState& state);

/// Inputs of the chassis below the controls; the controls compute them, and a manoeuvre may give them directly.
struct ChassisInput {
  double steer_rad = 0.0;  ///< Mean road-wheel angle of the front axle before toe and compliance.
  std::array<double, wheel_count> drive_torque_nm{};
  std::array<double, wheel_count> brake_torque_nm{};  ///< Largest friction torque; it never turns a wheel by itself.
};
void advance_chassis(const VehicleParameters& parameters, const ChassisInput& input, const Ground& ground, double dt_s,
                     VehicleState& state);

/// World positions of the wheels' centres; the caller finds the ground below them.
std::array<Vec3, wheel_count> wheel_centres_m(const VehicleParameters& parameters, const VehicleState& state);

/// Outputs for the snapshot, the instruments and the analysis.
struct VehicleOutputs {
  RigidTransform world_from_vehicle;  ///< Pose of the vehicle frame, carried by the body.
  Vec3 velocity_mps{0.0};             ///< Velocity of its origin, world frame.
  Vec3 acceleration_mps2{0.0};        ///< Acceleration of its origin, world frame.
  Vec3 angular_velocity_radps{0.0};   ///< World frame.
  double speed_mps = 0.0;             ///< Along the car's x axis.
  double yaw_rate_radps = 0.0;        ///< About the world's vertical.
  /// Acceleration of the whole car's centre of mass, horizontal, to the left (ISO 8855).
  double lateral_acceleration_mps2 = 0.0;
  double longitudinal_acceleration_mps2 = 0.0;  ///< Acceleration of that centre, horizontal, forward.
  /// Acceleration felt by a person in the car: at the centre of mass in the body frame.
  Vec3 specific_force_mps2{0.0};
  double sideslip_rad = 0.0;  ///< At the centre of mass; 0 below walking pace.
  double roll_rad = 0.0;      ///< Against the horizontal, positive leans to the right.
  double pitch_rad = 0.0;     ///< Positive dives.
  double engine_radps = 0.0;
  int gear = 0;
  double steering_torque_nm = 0.0;  ///< At the hand wheel, positive turns it to the left.
  double front_steer_rad = 0.0;     ///< Mean of the front wheels, with compliance.
  double wheel_spin_rad = 0.0;      ///< Mean of the rear wheels, in [0, 2π).
  double wheel_spin_radps = 0.0;
  std::array<double, wheel_count> wheel_lift_m{};  ///< Travel, positive in bump.
  std::array<double, wheel_count> wheel_load_n{};  ///< 0: the wheel is in the air.
  bool anti_lock_active = false;
  bool stability_control_active = false;
};
VehicleOutputs outputs(const VehicleParameters& parameters, const VehicleState& state);

}  // namespace septet::vehicle
