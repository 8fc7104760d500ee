#pragma once
/// What of a car has failed by itself: no collision broke it. Plain data, and what it makes of the car's parameters. Pure.
///
/// A tyre that loses its air is damage of a wheel (wheel_damage.hpp).

#include "engine/physics/vehicle/vehicle_parameters.hpp"
#include "engine/physics/vehicle/vehicle_state.hpp"

namespace septet::vehicle {

struct Faults {
  bool anti_lock =
      false;  ///< The unit of the brakes' control has switched itself off: no anti-lock, traction or stability control.
  bool misfire = false;  ///< One cylinder does not fire: its share of the torque is missing, it is dragged along.

  bool any() const { return anti_lock || misfire; }
  bool operator==(const Faults&) const = default;
};

/// The car with these faults.
VehicleParameters with_faults(const VehicleParameters& parameters, const Faults& faults);

/// What a control that has just switched itself off leaves: full pressure where the driver brakes, none where he does not.
void release_controls(VehicleState& state);

/// The wheel's tyre begins to lose its air, as if it had been cut; or it is another one, whole.
void puncture(WheelState& wheel);
void change_tyre(WheelState& wheel);

}  // namespace septet::vehicle
