#include "car-io/wheel_torque.hpp"

#include <algorithm>
#include <cmath>

namespace septet::car_io {
namespace {

constexpr double full_in_s = 0.05;
constexpr double stop_begins_before_rad = 0.1, stop_full_within_rad = 0.15;
constexpr double centring_share = 0.15, centring_full_at_rad = 1.0, centring_until_mps = 2.0;
constexpr double damping_share = 0.15, damping_full_at_radps = 12.0;

double number(double value) { return std::isfinite(value) ? value : 0.0; }

double within(double value) { return std::clamp(value, -1.0, 1.0); }

}  // namespace

double wheel_torque_nm(WheelTorqueState& state, const WheelMotion& motion, double full_nm, double dt_s) {
  const double wheel_rad = number(motion.wheel_rad);
  const double turning_radps = state.has_begun && dt_s > 0.0 ? (wheel_rad - state.wheel_rad) / dt_s : 0.0;
  const double standing = std::clamp(1.0 - std::abs(number(motion.speed_mps)) / centring_until_mps, 0.0, 1.0);
  double share = within(number(motion.column_torque_nm) / full_nm);
  share -= standing * centring_share * within(wheel_rad / centring_full_at_rad);
  share -= damping_share * within(turning_radps / damping_full_at_radps);
  const double beyond_rad = std::abs(wheel_rad) - (motion.lock_rad - stop_begins_before_rad);
  if (beyond_rad > 0.0) {
    // The end stop overrides all other forces.
    const double stop = std::min(beyond_rad / stop_full_within_rad, 1.0);
    share = (1.0 - stop) * share - stop * std::copysign(1.0, wheel_rad);
  }
  const double step_nm = full_nm * dt_s / full_in_s;
  state.torque_nm = std::clamp(full_nm * within(share), state.torque_nm - step_nm, state.torque_nm + step_nm);
  state.wheel_rad = wheel_rad;
  state.has_begun = true;
  return state.torque_nm;
}

}  // namespace septet::car_io
