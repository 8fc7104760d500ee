#pragma once
/// Faults of a car without a collision: plain data, and their effect on the car's parameters. Pure.
///
/// A tyre that loses its air is damage of a wheel (wheel_damage.hpp).

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

struct Faults {
  /// The brakes' control unit has switched itself off: no anti-lock, traction or stability control.
  bool anti_lock = false;
  bool misfire = false;  ///< One cylinder does not fire: its share of the torque is missing, it is dragged along.

  bool any() const { return anti_lock || misfire; }
  bool operator==(const Faults&) const = default;
};

/// The car's parameters with these faults.
VehicleParameters with_faults(const VehicleParameters& parameters, const Faults& faults);

/// Sets the brakes' state after their control has switched itself off: full pressure while the driver brakes, otherwise
/// zero.
void release_controls(VehicleState& state);

/// Cuts the wheel's tyre, so that it begins to lose its air; change_tyre fits a whole one.
void puncture(WheelState& wheel);
void change_tyre(WheelState& wheel);

}  // namespace septet::vehicle
