#pragma once
/// Guard between the requested and the executed motion of fan, shaker and hand wheel: after a fault everything goes to
/// 0 within `fall_s` and stays there, whatever is requested, until it is re-armed; then it returns over `rise_s`. A
/// pure function of its state.

#include <algorithm>

#include "car-io/car_report.hpp"

namespace septet::car_io {

struct ActuatorGuard {
  double fall_s = 0.2, rise_s = 1.0;
  double share = 1.0;  ///< Share of the request.
  bool is_cut = false;

  void rearm() { is_cut = false; }
  /// Immediately, without falling: an emergency stop.
  void stop() {
    is_cut = true;
    share = 0.0;
  }
  /// True if this fault cuts: once until it is re-armed.
  bool trip(bool fault) {
    const bool is_new = fault && !is_cut;
    is_cut = is_cut || fault;
    return is_new;
  }
  /// Permitted part of `wanted`, `dt_s` after the previous call.
  Actuators pass(Actuators wanted, double dt_s) {
    const double step = is_cut ? (fall_s > 0.0 ? -dt_s / fall_s : -1.0) : (rise_s > 0.0 ? dt_s / rise_s : 1.0);
    share = std::clamp(share + step, 0.0, 1.0);
    wanted.fan *= share;
    wanted.vibration *= share;
    wanted.steering *= share;
    return wanted;
  }
};

/// Command sent while the world stands still; no driven car produces it, since its shaker has a frequency. It re-arms.
inline bool is_rest(const Actuators& actuators) {
  return actuators.fan == 0.0 && actuators.vibration == 0.0 && actuators.vibration_hz == 0.0 &&
         actuators.steering == 0.0;
}

}  // namespace septet::car_io
