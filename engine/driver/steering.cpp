#include "engine/driver/steering.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/math/gravity.hpp"

namespace septet::driver {

namespace {

constexpr double least_mps = 5.0;

/// G: yaw rate by hand-wheel angle, in a steady state.
double yaw_gain_per_s(const CarKnowledge& car, double speed_mps) {
  const double v = std::max(speed_mps, least_mps);
  return v / (car.wheelbase_m + car.understeer_radps2pm * v * v) / car.steering_ratio;
}

}  // namespace

SteeringGains steering_gains(const SteeringParameters& steering, const CarKnowledge& car, double speed_mps) {
  const double v = std::max(speed_mps, least_mps);
  const double yaw_gain = yaw_gain_per_s(car, speed_mps);
  const double omega = steering.natural_frequency_radps;
  SteeringGains gains;
  gains.near = omega * omega * steering.near_distance_m / (v * yaw_gain);
  gains.far = std::max(0.0, 2.0 * steering.damping * omega / yaw_gain - gains.near);
  gains.integral_per_s = steering.integral_per_s * gains.near;
  return gains;
}

double steady_wheel_rad(const CarKnowledge& car, double speed_mps, double curvature_per_m, double roll_rad) {
  const double sideways_mps2 = speed_mps * speed_mps * curvature_per_m + gravity_mps2 * std::sin(roll_rad);
  return car.steering_ratio * (car.wheelbase_m * curvature_per_m + car.understeer_radps2pm * sideways_mps2);
}

double advance_steering(SteeringState& state, const SteeringParameters& steering, const CarKnowledge& car,
                        const PathAngles& path, bool sees_road, double speed_mps, double now_s, double dt_s,
                        Random& random) {
  const double position_error_m =
      state.position_error_m.advance(steering.position_noise_m, steering.position_noise_s, dt_s, random);
  const double heading_error_rad =
      state.heading_error_rad.advance(steering.heading_noise_rad, steering.heading_noise_s, dt_s, random);
  // A position error shifts the near point sideways, a heading error turns both.
  const double far_m = std::max(steering.near_distance_m, steering.far_time_s * speed_mps);
  const PathAngles seen{path.near_rad + heading_error_rad + position_error_m / steering.near_distance_m,
                        path.far_rad + heading_error_rad + position_error_m / far_m};
  const PathAngles& felt = state.eyes.through(now_s, seen, steering.delay_s);
  const double yaw_gain = yaw_gain_per_s(car, speed_mps);
  if (!state.has_seen) state.last = felt, state.yaw_gain_per_s = yaw_gain;
  state.has_seen = true;
  state.intended_rad *= std::exchange(state.yaw_gain_per_s, yaw_gain) / yaw_gain;

  const SteeringGains gains = steering_gains(steering, car, speed_mps);
  const double share = sees_road ? 1.0 : steering.peripheral_share;
  PathAngles answered{share * (felt.near_rad - state.last.near_rad), share * (felt.far_rad - state.last.far_rad)};
  state.unanswered.near_rad += felt.near_rad - state.last.near_rad - answered.near_rad;
  state.unanswered.far_rad += felt.far_rad - state.last.far_rad - answered.far_rad;
  state.last = felt;
  if (sees_road) {
    answered.near_rad += std::exchange(state.unanswered.near_rad, 0.0);
    answered.far_rad += std::exchange(state.unanswered.far_rad, 0.0);
  }
  const double lasting_rad = std::clamp(felt.near_rad, -steering.near_angle_limit_rad, steering.near_angle_limit_rad);
  state.intended_rad +=
      gains.far * answered.far_rad + gains.near * answered.near_rad + share * gains.integral_per_s * lasting_rad * dt_s;

  const double wanted_step = (state.intended_rad - state.hands_rad) * (1.0 - std::exp(-dt_s / steering.hand_lag_s));
  const double largest_step = steering.largest_rate_radps * dt_s;
  state.hands_rad += std::clamp(wanted_step, -largest_step, largest_step);
  return state.hands_rad;
}

}  // namespace septet::driver
