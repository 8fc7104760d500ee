#pragma once
/// One wheel during one step: where it meets the ground, the tyre's force there, and its new spin.
///
/// Body's axes unless a name says otherwise. Source of the tyre: tyre.hpp; of the suspension: suspension.hpp.

#include "engine/physics/vehicle/ground.hpp"
#include "engine/physics/vehicle/suspension.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

namespace septet::vehicle {

struct WheelLoad {
  WheelPlace place;
  Vec3 contact_m{0.0};
  Vec3 force_n{0.0};
  Vec3 aligning_nm{0.0};
  Vec3 rolling_n{0.0};             ///< Part of force_n along the wheel's heading.
  double rolling_torque_nm = 0.0;  ///< Torque of that part on the wheel, against its spin.
  double lean_nm = 0.0;            ///< Moment of the load on a contact shifted sideways.
  double shaft_torque_nm = 0.0;    ///< Drive and brake together, about the spin axis.
  double brake_torque_nm = 0.0;    ///< The brake's share.
};

/// What a wheel's step depends on beside the wheel itself.
struct WheelSurroundings {
  const VehicleParameters& parameters;
  const Statics& known;
  const ChassisInput& input;
  const WheelGround& ground;  ///< Under this wheel.
  const VehicleState& state;  ///< Of the car before the step; this wheel in it may be the one that is advanced.
  const Vec3& velocity_mps;   ///< Of the centre of the sprung mass.
  double dt_s = 0.0;
};

/// Advances one wheel's spin, deflection and damage by a step, and returns its load on the car.
WheelLoad advance_wheel(const WheelSurroundings& around, int index, WheelState& wheel);

}  // namespace septet::vehicle
