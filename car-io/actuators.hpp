#pragma once
/// Feedback of the car to its driver: fan, vibration and the force of the hand wheel, from the car's motion. Pure
/// functions.
///
/// The fan's air speed is proportional to the car's speed (Lebram, Engström and Gustavsson 2006, section 3.3). A shaker
/// has one frequency at a time: that of the strongest of engine (firing order k = cylinders / 2 of a four-stroke), road
/// (once a turn of the wheel), lines (their profile), kerbs (the wheel hops), crashes and anti-lock brakes; their
/// amplitudes add as squares. The channel of low frequencies has all of them at once (engine/audio).

#include "car-io/car_report.hpp"
#include "engine/rig/rig.hpp"

namespace septet::car_io {

/// Motion of the car, as far as the driver can feel it.
struct CarMotion {
  double speed_mps = 0.0;
  double engine_radps = 0.0;
  double engine_load = 0.0;  ///< 0 to 1.
  int cylinders = 6;
  double wheel_radius_m = 0.32;
  double roughness = 1.0;         ///< Roughness under the wheels: 1 a good road, more on a worse one.
  bool on_line = false;           ///< A wheel rolls over paint.
  double bump = 0.0, blow = 0.0;  ///< 0 to 1, decaying: a kerb or a piece under a wheel; the impact of a crash.
  bool anti_lock_active = false;
  double steering_torque_nm = 0.0;  ///< At the hand wheel, positive turns it to the left.
};

/// Within the rig's limits, for any motion.
Actuators actuators_for(const CarMotion& motion, const rig::CarActuators& limits);

}  // namespace septet::car_io
