#include "car-io/actuators.hpp"

#include <algorithm>
#include <cmath>

namespace septet::car_io {
namespace {

// Shares of the shaker's maximum; engineer's values, to be felt and changed.
constexpr double idling_engine = 0.10, loaded_engine = 0.30;
constexpr double road_at_30_mps = 0.25;
constexpr double line = 0.35, line_profile_m = 0.3048;  // Like a milled strip's 12 inches.
constexpr double bump = 0.90, wheel_hop_hz = 13.0, blow = 1.0, blow_hz = 30.0;
constexpr double anti_lock = 0.60, anti_lock_hz = 12.0;
constexpr double lowest_hz = 5.0, highest_hz = 200.0;  // Range of a shaker.

struct Shake {
  double amplitude = 0.0, frequency_hz = 0.0;
};

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

/// Duty of the fan, for this share of its greatest air speed.
double duty_for(double air_share, const rig::CarActuators& limits) {
  const auto& curve = limits.fan_curve;
  if (curve.empty()) return limits.fan_least + (1.0 - limits.fan_least) * air_share;
  const double wanted = air_share * curve.back().y;
  if (wanted <= curve.front().y) return curve.front().x;
  std::size_t upper = 1;
  while (upper + 1 < curve.size() && curve[upper].y < wanted) ++upper;
  const Vec2 &low = curve[upper - 1], &high = curve[upper];
  return low.x + (high.x - low.x) * std::clamp((wanted - low.y) / (high.y - low.y), 0.0, 1.0);
}

}  // namespace

Actuators actuators_for(const CarMotion& motion, const rig::CarActuators& limits) {
  const double speed_mps = std::abs(finite(motion.speed_mps));
  Actuators result;
  if (speed_mps > 0.5) {
    // The force of a jet of air grows with the square of its speed.
    const double speed_share = std::min(speed_mps / limits.fan_full_speed_mps, 1.0);
    const double share = limits.fan_follows == rig::CarActuators::Wind::force ? std::sqrt(speed_share) : speed_share;
    result.fan = std::min(duty_for(share, limits), 1.0) * limits.fan_most;
  }

  constexpr double turn_rad = 2.0 * std::numbers::pi;
  const double engine_hz = std::max(0.0, finite(motion.engine_radps)) / turn_rad;
  const double load = std::clamp(finite(motion.engine_load), 0.0, 1.0);
  // The velocity of a road's unevenness is white noise, so its size grows with the root of the
  // speed (ISO 8608, waviness 2).
  const Shake shakes[] = {
      {engine_hz > 1.0 ? idling_engine + load * (loaded_engine - idling_engine) : 0.0,
       engine_hz * motion.cylinders / 2.0},
      {road_at_30_mps * std::clamp(finite(motion.roughness), 0.0, 10.0) * std::sqrt(speed_mps / 30.0),
       speed_mps / (turn_rad * std::max(motion.wheel_radius_m, 0.1))},
      {motion.on_line ? line * std::min(speed_mps / 5.0, 1.0) : 0.0, speed_mps / line_profile_m},
      {bump * std::clamp(finite(motion.bump), 0.0, 1.0), wheel_hop_hz},
      {blow * std::clamp(finite(motion.blow), 0.0, 1.0), blow_hz},
      {motion.anti_lock_active ? anti_lock : 0.0, anti_lock_hz}};
  double power = 0.0;
  Shake strongest;
  for (const Shake& shake : shakes) {
    power += shake.amplitude * shake.amplitude;
    if (shake.amplitude > strongest.amplitude) strongest = shake;
  }
  result.vibration = std::min(std::sqrt(power), 1.0) * limits.vibration_most;
  result.vibration_hz = std::clamp(strongest.frequency_hz, lowest_hz, highest_hz);
  result.steering =
      std::clamp(finite(motion.steering_torque_nm) / limits.steering_full_nm, -1.0, 1.0) * limits.steering_most;
  return result;
}

}  // namespace septet::car_io
