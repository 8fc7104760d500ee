#include "engine/driver/pedals.hpp"

#include <algorithm>
#include <cmath>

namespace septet::driver {
namespace {

constexpr double foot_move_s = 0.25;
constexpr double accelerator_rate_ps = 1.5, brake_rate_ps = 4.0, release_rate_ps = 4.0;
constexpr double seat_gain_s2pm_ps = 0.10;  ///< Accelerator per second and m/s² that the car lacks.
constexpr double coasting_mps2 = 0.35;      ///< Engine's drag with the foot off, beside air and rolling.
/// Required to avoid the leader: from here on the foot moves as fast as it can.
constexpr double emergency_mps2 = -3.5;
constexpr double emergency_jerk_mps3 = 20.0;
constexpr double hardest_braking_mps2 = -9.0;
constexpr double least_gap_m = 0.5;
constexpr double braking_lasts_s = 1.0;  ///< Expected duration of a leader's braking.

double approached(double value, double target, double step) { return value + std::clamp(target - value, -step, step); }

double expected_speed_mps(const Obstacle& obstacle) {
  return std::max(obstacle.speed_mps + std::min(obstacle.acceleration_mps2, 0.0) * braking_lasts_s, 0.0);
}

}  // namespace

double wanted_gap_m(const SpeedParameters& speed, double own_speed_mps, double leader_speed_mps) {
  const double closing = own_speed_mps * (own_speed_mps - leader_speed_mps) /
                         (2.0 * std::sqrt(speed.acceleration_mps2 * speed.braking_mps2));
  return speed.standstill_gap_m + std::max(0.0, own_speed_mps * speed.time_gap_s + closing);
}

double heuristic_acceleration_mps2(double own_speed_mps, const Obstacle& obstacle) {
  const double closing_mps = std::max(own_speed_mps - expected_speed_mps(obstacle), 0.0);
  return std::max(-closing_mps * closing_mps / (2.0 * std::max(obstacle.gap_m, least_gap_m)), -obstacle.worth_mps2);
}

double wished_acceleration_mps2(const SpeedParameters& speed, double own_speed_mps, double desired_speed_mps,
                                const std::optional<Obstacle>& obstacle) {
  const double v = std::max(0.0, own_speed_mps), desired_v = std::max(desired_speed_mps, 0.1);
  const double a = speed.acceleration_mps2, b = speed.braking_mps2;
  const double free =
      v <= desired_v ? a * (1.0 - std::pow(v / desired_v, 4)) : -b * (1.0 - std::pow(desired_v / v, 4.0 * a / b));
  if (!obstacle) return free;
  const double tightness =
      wanted_gap_m(speed, v, expected_speed_mps(*obstacle)) / std::max(obstacle->gap_m, least_gap_m);
  double gap_keeping = 0.0;
  if (v > desired_v)
    gap_keeping = free + (tightness >= 1.0 ? a * (1.0 - tightness * tightness) : 0.0);
  else if (tightness >= 1.0)
    gap_keeping = a * (1.0 - tightness * tightness);
  else
    gap_keeping = free > 0.0 ? free * (1.0 - std::pow(tightness, 2.0 * a / free)) : free;
  gap_keeping = std::max({gap_keeping, hardest_braking_mps2, -obstacle->worth_mps2});
  const double heuristic = heuristic_acceleration_mps2(v, *obstacle);
  if (gap_keeping >= heuristic) return gap_keeping;
  const double calm = heuristic + b * std::tanh((gap_keeping - heuristic) / b);
  return std::max(
      {(1.0 - speed.coolness) * gap_keeping + speed.coolness * calm, hardest_braking_mps2, -obstacle->worth_mps2});
}

void advance_pedals(PedalState& state, const SpeedParameters& speed, const CarKnowledge& car, const OwnPlace& own,
                    double desired_speed_mps, std::optional<Obstacle> obstacle, double dt_s, Random& random) {
  const double distance_error = state.distance_error.advance(speed.distance_noise, speed.noise_s, dt_s, random);
  const double speed_error = state.speed_error.advance(speed.speed_noise, speed.noise_s, dt_s, random);
  if (obstacle) obstacle->gap_m *= 1.0 + distance_error;
  const double wish = wished_acceleration_mps2(speed, own.speed_mps * (1.0 + speed_error), desired_speed_mps, obstacle);
  const bool emergency = obstacle && heuristic_acceleration_mps2(own.speed_mps, *obstacle) < emergency_mps2;
  const double jerk_mps3 = emergency ? emergency_jerk_mps3 : speed.largest_jerk_mps3;
  state.wish_mps2 = approached(state.wish_mps2, wish, jerk_mps3 * dt_s);

  const double v = std::max(0.0, own.speed_mps);
  const double drag_mps2 = car.rolling_drag_mps2 + car.drag_per_speed2_pm * v * v;
  const double full_mps2 = std::min(car.strongest_acceleration_mps2, car.power_per_mass_wpkg / std::max(v, 1.0));
  const bool stands = v < 0.3 && state.wish_mps2 < 0.1;
  const bool wants_brake =
      stands || state.wish_mps2 < -(drag_mps2 + coasting_mps2) + (state.foot_on_brake ? 0.15 : -0.05);
  if (wants_brake != state.foot_on_brake && state.foot_moves_s <= 0.0 && state.accelerator + state.brake < 0.02) {
    state.foot_on_brake = wants_brake;
    state.foot_moves_s = foot_move_s;
  }
  state.foot_moves_s = std::max(0.0, state.foot_moves_s - dt_s);

  double accelerator = 0.0, brake = 0.0;
  if (wants_brake == state.foot_on_brake && state.foot_moves_s <= 0.0) {
    if (state.foot_on_brake) {
      brake = stands ? 0.25
                     : std::clamp((-state.wish_mps2 - drag_mps2 - coasting_mps2) / car.strongest_braking_mps2 + 0.02,
                                  0.0, 1.0);
    } else {
      state.seat_correction = std::clamp(
          state.seat_correction + seat_gain_s2pm_ps * (state.wish_mps2 - own.acceleration_mps2) * dt_s, -0.3, 0.6);
      accelerator = std::clamp((state.wish_mps2 + drag_mps2) / full_mps2 + state.seat_correction, 0.0, 1.0);
    }
  }
  state.accelerator = approached(state.accelerator, accelerator,
                                 (accelerator > state.accelerator ? accelerator_rate_ps : release_rate_ps) * dt_s);
  state.brake = approached(state.brake, brake, (brake > state.brake ? brake_rate_ps : release_rate_ps) * dt_s);
}

}  // namespace septet::driver
