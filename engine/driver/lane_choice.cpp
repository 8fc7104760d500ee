#include "engine/driver/lane_choice.hpp"

#include <algorithm>
#include <cmath>

namespace septet::driver {
namespace {

constexpr double thought_interval_s = 0.5;
/// Below this speed the path across is a function of distance: a standing car does not slide sideways.
constexpr double slow_mps = 8.0;

constexpr double slowest_preview_mps = 5.0;

double pace(double own_speed_mps) { return std::clamp(own_speed_mps / slow_mps, 0.0, 1.0); }

bool is_in(const SeenVehicle& vehicle, int lane) {
  return vehicle.innermost_lane <= lane && lane <= vehicle.outermost_lane;
}

bool lies_left(const LaneScene& scene, int lane) { return (lane < scene.own.lane) == scene.grows_to_the_right; }

/// Acceleration that a lane offers by the plain intelligent driver model, which reacts to a slower vehicle long before
/// the foot has to.
double offer_mps2(const LaneScene& scene, int lane, const DriverParameters& driver) {
  const double a = driver.speed.acceleration_mps2, v = std::max(scene.own.speed_mps, 0.0);
  double tightest = 0.0;
  for (const SeenVehicle& vehicle : scene.vehicles)
    if (vehicle.is_ahead && (is_in(vehicle, lane) || vehicle.is_ambulance))
      tightest = std::max(tightest, wanted_gap_m(driver.speed, v, vehicle.speed_mps) / std::max(vehicle.gap_m, 0.5));
  return a * (1.0 - std::pow(v / std::max(scene.desired_speed_mps, 0.1), 4) - tightest * tightest);
}

/// Value of a lane, m/s²: its acceleration and the driver's preferences.
double value_of(const LaneScene& scene, int lane, const DriverParameters& driver) {
  double value = offer_mps2(scene, lane, driver);
  // No overtaking on the outer side.
  if (lane > scene.own.lane) value = std::min(value, offer_mps2(scene, scene.own.lane, driver));
  // A lane that ends is a wall at its end.
  if (lane == scene.own.lane && scene.lane_ends_in_m < 500.0)
    value = std::min(value, wished_acceleration_mps2(driver.speed, scene.own.speed_mps, scene.desired_speed_mps,
                                                     Obstacle{scene.lane_ends_in_m, 0.0}));
  value = std::max(value, -4.0) + driver.lanes.keep_out_mps2 * (lane - scene.own.lane);
  for (const SeenVehicle& vehicle : scene.vehicles)
    if (vehicle.is_ambulance && vehicle.is_ahead)
      value -= driver.lanes.follow_ambulance_mps2 *
               (std::abs(vehicle.lane - lane) - std::abs(vehicle.lane - scene.own.lane));
  return value;
}

/// The adjacent lane that is worth a change, or the present one.
int wished_lane(const LaneScene& scene, const DriverParameters& driver) {
  if (scene.wanted_lane) {
    const int towards = *scene.wanted_lane - scene.own.lane;
    if (towards < 0 && scene.open_inside) return scene.own.lane - 1;
    if (towards > 0 && scene.open_outside) return scene.own.lane + 1;
    return scene.own.lane;
  }
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

/// From the car's place and motion on its path.
void turn_back(LaneState& state, const LaneChoiceParameters& lanes) {
  const WayPoint now = point_on_way(state.way, state.phase_s);
  state.way = {now.at, now.rate_ps, now.rate_change_ps2, 0.0, lanes.duration_s};
  enter(state, LanePhase::go_back);
}

}  // namespace

std::optional<Obstacle> obstacle_in_lane(const LaneScene& scene, int lane, const SpeedParameters& speed) {
  std::optional<Obstacle> hardest;
  double least_mps2 = 0.0;
  for (const SeenVehicle& vehicle : scene.vehicles) {
    if (!vehicle.is_ahead || !(is_in(vehicle, lane) || vehicle.is_ambulance)) continue;
    // A beacon is visible from afar.
    if (!vehicle.is_ambulance && vehicle.gap_m > speed.preview_s * std::max(scene.own.speed_mps, slowest_preview_mps))
      continue;
    Obstacle obstacle{vehicle.gap_m, vehicle.speed_mps, vehicle.acceleration_mps2};
    if (warns(vehicle)) obstacle.gap_m -= std::min(speed.warned_gap_m, 0.8 * std::max(vehicle.gap_m, 0.0));
    if (!is_in(vehicle, lane)) obstacle.worth_mps2 = speed.braking_mps2;
    const double wish_mps2 = wished_acceleration_mps2(speed, scene.own.speed_mps, scene.desired_speed_mps, obstacle);
    if (hardest && wish_mps2 >= least_mps2) continue;
    hardest = obstacle;
    least_mps2 = wish_mps2;
  }
  return hardest;
}

std::optional<Obstacle> obstacle_on_way(const LaneState& state, const LaneScene& scene, const SpeedParameters& speed) {
  if (state.phase < LanePhase::change) return obstacle_in_lane(scene, state.lane, speed);
  const int to = state.phase == LanePhase::change ? state.target : state.lane;
  const int from = state.phase == LanePhase::change ? state.lane : state.target;
  const auto there = obstacle_in_lane(scene, to, speed);
  const bool from_lies_left = (from < to) == scene.grows_to_the_right;
  const double room_m = from_lies_left ? scene.own.room_left_m : scene.own.room_right_m;
  if (scene.own.lane == to && room_m > 0.0) return there;
  const auto here = obstacle_in_lane(scene, from, speed);
  const auto wish_mps2 = [&](const std::optional<Obstacle>& obstacle) {
    return wished_acceleration_mps2(speed, scene.own.speed_mps, scene.desired_speed_mps, obstacle);
  };
  return wish_mps2(here) < wish_mps2(there) ? here : there;
}

bool is_safe(const LaneScene& scene, int lane, const DriverParameters& driver, double strictness) {
  const double own_mps = scene.own.speed_mps;
  const double until_crossed_s = strictness * driver.lanes.duration_s / 2.0;
  for (const SeenVehicle& vehicle : scene.vehicles) {
    if (!is_in(vehicle, lane)) continue;
    const double behind_mps = vehicle.is_ahead ? own_mps : vehicle.speed_mps;
    const double ahead_mps = vehicle.is_ahead ? vehicle.speed_mps : own_mps;
    const double closing_mps = std::max(behind_mps - ahead_mps, 0.0);
    const double needed_m =
        strictness * (driver.speed.standstill_gap_m + driver.lanes.accepted_gap * driver.speed.time_gap_s * behind_mps);
    const double left_m = vehicle.gap_m - closing_mps * until_crossed_s - needed_m;
    if (left_m < 0.0) return false;
    // Braking that removes the closing speed within the remaining distance.
    if (closing_mps * closing_mps > 2.0 * left_m * driver.lanes.safe_braking_mps2 / strictness) return false;
  }
  return true;
}

WayPoint point_on_way(const LaneWay& way, double time_s) {
  if (time_s >= way.duration_s) return {way.to, 0.0, 0.0};
  const double t = std::max(time_s, 0.0), T = way.duration_s;
  const double p = way.from, v = way.from_rate_ps, a = way.from_rate_change_ps2;
  // Rest for the higher powers, after the motion at the beginning.
  const double place = way.to - (p + v * T + a * T * T / 2.0), rate = -(v + a * T), change = -a;
  const double c3 = (10.0 * place - 4.0 * rate * T + change * T * T / 2.0) / (T * T * T);
  const double c4 = (-15.0 * place + 7.0 * rate * T - change * T * T) / (T * T * T * T);
  const double c5 = (6.0 * place - 3.0 * rate * T + change * T * T / 2.0) / (T * T * T * T * T);
  return {p + t * (v + t * (a / 2.0 + t * (c3 + t * (c4 + t * c5)))),
          v + t * (a + t * (3.0 * c3 + t * (4.0 * c4 + t * 5.0 * c5))),
          a + t * (6.0 * c3 + t * (12.0 * c4 + t * 20.0 * c5))};
}

double place_across(const LaneState& state, double own_speed_mps, double ahead_s) {
  if (state.phase < LanePhase::change) return 0.0;
  return point_on_way(state.way, state.phase_s + pace(own_speed_mps) * ahead_s).at;
}

void advance_lane_choice(LaneState& state, const DriverParameters& driver, const LaneScene& scene, MirrorState& mirrors,
                         const std::optional<Mirror>& looked, double dt_s, Random& random) {
  state.phase_s += state.phase < LanePhase::change ? dt_s : pace(scene.own.speed_mps) * dt_s;
  state.since_change_s += dt_s;
  const auto mirror_of_target = [&] { return lies_left(scene, state.target) ? Mirror::left : Mirror::right; };
  const auto begin_change = [&] {
    if (!is_safe(scene, state.target, driver)) return give_up(state);
    state.way = {.duration_s = driver.lanes.duration_s};
    enter(state, LanePhase::change);
  };
  switch (state.phase) {
    case LanePhase::keep:
      state.next_thought_s -= dt_s;
      if (state.next_thought_s > 0.0) return;
      state.next_thought_s = thought_interval_s;
      if (state.since_change_s < (scene.wanted_lane ? 1.0 : driver.lanes.pause_s) || scene.own.speed_mps < 3.0) return;
      state.target = wished_lane(scene, driver);
      if (state.target != state.lane && begin_glance(mirrors, mirror_of_target(), driver.mirrors, random))
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
      if (driver.lanes.looks_again < 1.0 && random.uniform() >= driver.lanes.looks_again) return begin_change();
      if (begin_glance(mirrors, mirror_of_target(), driver.mirrors, random)) enter(state, LanePhase::look_again);
      return;
    case LanePhase::look_again:
      if (!looked) return;
      return begin_change();
    case LanePhase::change:
      if (scene.own.lane != state.target && !is_safe(scene, state.target, driver, driver.lanes.strictness_underway))
        return turn_back(state, driver.lanes);
      if (state.phase_s < state.way.duration_s) return;
      state.lane = state.target;
      state.since_change_s = 0.0;
      return enter(state, LanePhase::keep);
    case LanePhase::go_back:
      if (state.phase_s < state.way.duration_s) return;
      state.since_change_s = 0.0;
      return give_up(state);
  }
}

}  // namespace septet::driver
