#include "car-io/simulated_driver/lane_choice.hpp"

#include <algorithm>
#include <cmath>

namespace septet::car_io {
namespace {

constexpr double thought_interval_s = 0.5;

bool is_in(const SeenVehicle& vehicle, int lane) {
  return vehicle.lane == lane || vehicle.also_in_lane == lane;
}

bool lies_left(const LaneScene& scene, int lane) {
  return (lane < scene.own.lane) == scene.grows_to_the_right;
}

double wish_in_lane(const LaneScene& scene, int lane, const DriverParameters& driver) {
  return wished_acceleration_mps2(driver.speed, scene.own.speed_mps, scene.desired_speed_mps,
                                  obstacle_in_lane(scene, lane));
}

/// What a lane offers, m/s²: its acceleration and the driver's likings.
double value_of(const LaneScene& scene, int lane, const DriverParameters& driver) {
  double value = wish_in_lane(scene, lane, driver);
  // Nobody is passed on the outer side.
  if (lane > scene.own.lane) value = std::min(value, wish_in_lane(scene, scene.own.lane, driver));
  // A lane that ends is a wall at its end.
  if (lane == scene.own.lane && scene.lane_ends_in_m < 500.0)
    value = std::min(
        value, wished_acceleration_mps2(driver.speed, scene.own.speed_mps, scene.desired_speed_mps,
                                        Obstacle{scene.lane_ends_in_m, 0.0}));
  value = std::max(value, -4.0) + driver.lanes.keep_out_mps2 * (lane - scene.own.lane);
  for (const SeenVehicle& vehicle : scene.vehicles)
    if (vehicle.is_ambulance && vehicle.is_ahead)
      value -= driver.lanes.follow_ambulance_mps2 *
               (std::abs(vehicle.lane - lane) - std::abs(vehicle.lane - scene.own.lane));
  return value;
}

/// The lane beside the present one that is worth a change, or the present one.
int wished_lane(const LaneScene& scene, const DriverParameters& driver) {
  int best = scene.own.lane;
  double best_value = value_of(scene, scene.own.lane, driver) + driver.lanes.threshold_mps2;
  for (const int lane : {scene.own.lane - 1, scene.own.lane + 1}) {
    if (!(lane < scene.own.lane ? scene.open_inside : scene.open_outside)) continue;
    const double value = value_of(scene, lane, driver);
    if (value > best_value) {
      best = lane;
      best_value = value;
    }
  }
  return best;
}

void enter(LaneState& state, LanePhase phase) {
  state.phase = phase;
  state.phase_s = 0.0;
}

void give_up(LaneState& state) {
  state.target = state.lane;
  enter(state, LanePhase::keep);
}

}  // namespace

std::optional<Obstacle> obstacle_in_lane(const LaneScene& scene, int lane) {
  std::optional<Obstacle> nearest;
  for (const SeenVehicle& vehicle : scene.vehicles)
    if (vehicle.is_ahead && (is_in(vehicle, lane) || vehicle.is_ambulance) &&
        (!nearest || vehicle.gap_m < nearest->gap_m))
      nearest = Obstacle{vehicle.gap_m, vehicle.speed_mps};
  return nearest;
}

bool is_safe(const LaneScene& scene, int lane, const DriverParameters& driver) {
  const double own_speed = scene.own.speed_mps;
  for (const SeenVehicle& vehicle : scene.vehicles) {
    if (!is_in(vehicle, lane)) continue;
    const double needed_m = driver.speed.standstill_gap_m + 0.25 * own_speed;
    if (vehicle.gap_m < needed_m) return false;
    const double closing_mps =
        vehicle.is_ahead ? own_speed - vehicle.speed_mps : vehicle.speed_mps - own_speed;
    // Braking that takes the closing speed out of the gap, less what is to remain of it.
    if (closing_mps > 0.0 && closing_mps * closing_mps / (2.0 * (vehicle.gap_m - needed_m + 1.0)) >
                                 driver.lanes.safe_braking_mps2)
      return false;
  }
  return true;
}

double change_progress(const LaneChoiceParameters& lanes, double phase_s) {
  const double u = std::clamp(phase_s / lanes.duration_s, 0.0, 1.0);
  return u * u * u * (10.0 - 15.0 * u + 6.0 * u * u);
}

void advance_lane_choice(LaneState& state, const DriverParameters& driver, const LaneScene& scene,
                         MirrorState& mirrors, const std::optional<Mirror>& looked, double dt_s,
                         Random& random) {
  state.phase_s += dt_s;
  state.since_change_s += dt_s;
  const auto mirror_of_target = [&] {
    return lies_left(scene, state.target) ? Mirror::left : Mirror::right;
  };
  switch (state.phase) {
    case LanePhase::keep:
      state.next_thought_s -= dt_s;
      if (state.next_thought_s > 0.0) return;
      state.next_thought_s = thought_interval_s;
      if (state.since_change_s < driver.lanes.pause_s || scene.own.speed_mps < 3.0) return;
      state.target = wished_lane(scene, driver);
      if (state.target != state.lane &&
          begin_glance(mirrors, mirror_of_target(), driver.mirrors, random))
        enter(state, LanePhase::look);
      else
        state.target = state.lane;
      return;
    case LanePhase::look:
      if (!looked) return;
      if (is_safe(scene, state.target, driver) && wished_lane(scene, driver) == state.target)
        enter(state, LanePhase::signal);
      else
        give_up(state);
      return;
    case LanePhase::signal:
      if (state.phase_s < driver.lanes.signal_s) return;
      if (begin_glance(mirrors, mirror_of_target(), driver.mirrors, random))
        enter(state, LanePhase::look_again);
      return;
    case LanePhase::look_again:
      if (!looked) return;
      is_safe(scene, state.target, driver) ? enter(state, LanePhase::change) : give_up(state);
      return;
    case LanePhase::change:
      if (state.phase_s < driver.lanes.duration_s) return;
      state.lane = state.target;
      state.since_change_s = 0.0;
      enter(state, LanePhase::keep);
      return;
  }
}

}  // namespace septet::car_io
