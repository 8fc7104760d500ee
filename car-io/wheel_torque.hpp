#pragma once
/// What the hand wheel's motor does of the steering column's torque: limited, never in a jolt, with ends to run into and a middle at standstill.
///
/// A tyre that stands has no aligning torque worth feeling, and a wheel without ends turns on beyond the lock of the simulated column: both
/// would feel like a toy. Stiffnesses are shares of the motor's full torque; engineer's values, to be felt and changed. A pure function of its
/// state; numbers that are none count as 0.

namespace septet::car_io {

struct WheelTorqueState {
  double torque_nm = 0.0;  ///< As last returned.
  double wheel_rad = 0.0;
  bool has_begun = false;
};

struct WheelMotion {
  double column_torque_nm = 0.0;  ///< Of the simulation; positive turns the wheel to the left, as its angle counts.
  double wheel_rad = 0.0;
  double speed_mps = 0.0;
  double lock_rad = 7.85;  ///< Full left.
};

/// Within ±`full_nm`, and no further from what it was than the motor's full torque in 50 ms.
double wheel_torque_nm(WheelTorqueState& state, const WheelMotion& motion, double full_nm, double dt_s);

}  // namespace septet::car_io
