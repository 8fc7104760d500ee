#pragma once
/// The state of one car from one step to the next: nothing that can be computed from it, except the forces of the last
/// step, which the outputs report.

#include <array>
#include <cstdint>

#include "engine/core/hash.hpp"
#include "engine/math/rigid_transform.hpp"
#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/wheel_damage.hpp"

namespace septet::vehicle {

struct WheelState {
  double travel_m = 0.0, travel_rate_mps = 0.0;
  double spin_rad = 0.0, spin_radps = 0.0;
  Vec2 deflection_m{0.0};  ///< Deflection of the contact patch against the rim: forward, left. Carries the relaxation.
  WheelDamage damage;
  // Results of the last step.
  double squeeze_m = 0.0;    ///< Deflection of the tyre against the rim, towards the ground.
  Vec3 force_n{0.0};         ///< On the wheel, in the contact's frame: forward, left, along the normal.
  double aligning_nm = 0.0;  ///< On the wheel, about the normal, positive turns it to the left.
  double steer_rad = 0.0;    ///< Against the body, with toe and compliance, positive to the left.
  double slip = 0.0,
         slip_angle_rad = 0.0;  ///< Longitudinal, positive when driven; lateral, by ISO 8855.
};

struct SteeringState {
  double column_rad = 0.0;  ///< Rack, counted at the hand wheel: hand wheel less twist of the column.
  double torque_nm = 0.0;   ///< Steering torque at the driver's hands, positive turns the hand wheel to the left.
};

struct PowertrainState {
  double engine_radps = 0.0;
  double engine_torque_nm = 0.0;
  bool engine_running = true;
  double clutch_nm = 0.0;     ///< Wound up in the driveline behind a closed clutch.
  std::int8_t gear = 0;       ///< Engaged: −1 reverse, 0 neutral, 1…
  std::int8_t next_gear = 0;  ///< Equal to `gear` except during a shift.
  double shift_s = 0.0;       ///< Time into the shift.
  double since_shift_s = 0.0;
};

struct BrakeState {
  double pedal = 0.0;                             ///< Behind the lag.
  std::array<double, wheel_count> release{};      ///< 0 full pressure to 1 released, by the anti-lock system.
  std::array<double, wheel_count> stabilising{};  ///< Pressure added by the stability control, 0 to 1.
  /// Bound on the difference of the front wheels' pressures, as a share of full pressure.
  double front_difference = 0.02;
  double torque_cut = 0.0;  ///< Reduction of the engine's torque by traction and stability control, 0 to 1.
};

struct VehicleState {
  RigidTransform world_from_body;    ///< Origin in the centre of the sprung mass, axes of the vehicle frame.
  Vec3 velocity_mps{0.0};            ///< Velocity of that centre, world frame.
  Vec3 angular_velocity_radps{0.0};  ///< Body frame.
  std::array<WheelState, wheel_count> wheels;
  SteeringState steering;
  PowertrainState powertrain;
  BrakeState brakes;
  // Results of the last step.
  Vec3 acceleration_mps2{0.0};            ///< Acceleration of the centre of the sprung mass, world frame.
  Vec3 whole_acceleration_mps2{0.0};      ///< Acceleration of the whole car's centre of mass, world frame.
  Vec3 angular_acceleration_radps2{0.0};  ///< Body frame.
  std::uint32_t bad_numbers = 0;          ///< Steps that were undone because a number was not finite.
};

void hash_state(StateHash& hash, const VehicleState& state);

}  // namespace septet::vehicle
