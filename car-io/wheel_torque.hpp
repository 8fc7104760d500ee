#pragma once
/// Force of the hand wheel's motor from the steering column's torque: limited, free of jolts, with end stops and a
/// centre at standstill.
///
/// A standing tyre has hardly any aligning torque, and a wheel without end stops turns on beyond the lock of the
/// simulated column: both would feel like a toy. Stiffnesses are shares of the motor's full torque; engineer's values,
/// to be felt and changed. A pure function of its state; NaN and infinite values count as 0.

namespace septet::car_io {

struct WheelTorqueState {
  double torque_nm = 0.0;  ///< Last returned value.
  double wheel_rad = 0.0;
  bool has_begun = false;
};

struct WheelMotion {
  double column_torque_nm = 0.0;  ///< From the simulation; positive turns the wheel to the left, as its angle counts.
  double wheel_rad = 0.0;
  double speed_mps = 0.0;
  double lock_rad = 7.85;  ///< Full left.
};

/// Within ±`full_nm`, and changing by no more than the motor's full torque in 50 ms.
double wheel_torque_nm(WheelTorqueState& state, const WheelMotion& motion, double full_nm, double dt_s);

}  // namespace septet::car_io
