#include "car-io/simulated_driver/pedals.hpp"

#include <algorithm>
#include <cmath>

namespace septet::car_io {
namespace {

constexpr double foot_move_s = 0.25;
constexpr double accelerator_rate_ps = 1.5, brake_rate_ps = 4.0, release_rate_ps = 4.0;
constexpr double seat_gain_s2pm_ps = 0.10;  ///< Accelerator per second and m/s² that the car lacks.
constexpr double coasting_mps2 =
    0.35;  ///< Engine's drag with the foot off, beside air and rolling.
constexpr double emergency_mps2 = -3.5;

double approach(double value, double target, double step) {
  return value + std::clamp(target - value, -step, step);
}

}  // namespace

double wished_acceleration_mps2(const SpeedParameters& speed, double own_speed_mps,
                                double desired_speed_mps, const std::optional<Obstacle>& obstacle) {
  const double v = std::max(0.0, own_speed_mps), ratio = v / std::max(desired_speed_mps, 0.1);
  double interaction = 0.0;
  if (obstacle) {
    const double closing = v * (v - obstacle->speed_mps) /
                           (2.0 * std::sqrt(speed.acceleration_mps2 * speed.braking_mps2));
    const double wanted_m = speed.standstill_gap_m + std::max(0.0, v * speed.time_gap_s + closing);
    interaction = std::pow(wanted_m / std::max(obstacle->gap_m, 0.5), 2);
  }
  return std::max(speed.acceleration_mps2 * (1.0 - std::pow(ratio, 4) - interaction), -9.0);
}

void advance_pedals(PedalState& state, const SpeedParameters& speed, const CarKnowledge& car,
                    const OwnPlace& own, double desired_speed_mps,
                    const std::optional<Obstacle>& obstacle, double now_s, double dt_s,
                    Random& random) {
  const double distance_error =
      state.distance_error.advance(speed.distance_noise, speed.noise_s, dt_s, random);
  const double speed_error =
      state.speed_error.advance(speed.distance_noise / 4.0, speed.noise_s, dt_s, random);
  std::optional<Obstacle> felt = state.eyes.through(now_s, obstacle, speed.reaction_time_s);
  if (felt) felt->gap_m *= 1.0 + distance_error;
  const double wish =
      wished_acceleration_mps2(speed, own.speed_mps * (1.0 + speed_error), desired_speed_mps, felt);
  const double jerk_mps3 = wish < emergency_mps2 ? 20.0 : speed.largest_jerk_mps3;
  state.wish_mps2 = approach(state.wish_mps2, wish, jerk_mps3 * dt_s);

  const double v = std::max(0.0, own.speed_mps);
  const double drag_mps2 = car.rolling_drag_mps2 + car.drag_per_speed2_pm * v * v;
  const double full_mps2 =
      std::min(car.strongest_acceleration_mps2, car.power_per_mass_wpkg / std::max(v, 1.0));
  const bool stands = v < 0.3 && state.wish_mps2 < 0.1;
  const bool wants_brake = stands || state.wish_mps2 < -(drag_mps2 + coasting_mps2) +
                                                           (state.foot_on_brake ? 0.15 : -0.05);
  if (wants_brake != state.foot_on_brake && state.foot_moves_s <= 0.0 &&
      state.accelerator + state.brake < 0.02) {
    state.foot_on_brake = wants_brake;
    state.foot_moves_s = foot_move_s;
  }
  state.foot_moves_s = std::max(0.0, state.foot_moves_s - dt_s);

  double accelerator = 0.0, brake = 0.0;
  if (wants_brake == state.foot_on_brake && state.foot_moves_s <= 0.0) {
    if (state.foot_on_brake) {
      brake = stands ? 0.25
                     : std::clamp((-state.wish_mps2 - drag_mps2 - coasting_mps2) /
                                          car.strongest_braking_mps2 +
                                      0.02,
                                  0.0, 1.0);
    } else {
      state.seat_correction =
          std::clamp(state.seat_correction +
                         seat_gain_s2pm_ps * (state.wish_mps2 - own.acceleration_mps2) * dt_s,
                     -0.3, 0.6);
      accelerator =
          std::clamp((state.wish_mps2 + drag_mps2) / full_mps2 + state.seat_correction, 0.0, 1.0);
    }
  }
  state.accelerator =
      approach(state.accelerator, accelerator,
               (accelerator > state.accelerator ? accelerator_rate_ps : release_rate_ps) * dt_s);
  state.brake =
      approach(state.brake, brake, (brake > state.brake ? brake_rate_ps : release_rate_ps) * dt_s);
}

}  // namespace septet::car_io
