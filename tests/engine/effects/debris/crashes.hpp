#pragma once
/// A car with all detachable parts, and its crash into a wall, for the tests.

#include "engine/effects/debris/crash.hpp"

namespace septet::debris {

inline constexpr double crash_speed_mps = 70.0 / 3.6;

inline CrashBody car_at(double x_m, double speed_mps) {
  CrashBody car;
  car.box.world_from_box.position_m = {x_m, 0, 0.75};
  car.box.half_size_m = {2.2, 0.9, 0.7};
  car.box.velocity_mps = {speed_mps, 0, 0};
  car.mass_kg = 1500.0;
  car.parts = passenger_car_parts(car.box.half_size_m);
  return car;
}

/// A car whose front touches a wall at x = 0.
inline Crash into_barrier(double speed_mps) {
  Crash crash;
  crash.point_m = {0, 0, 0.5};
  crash.normal = {-1, 0, 0};
  crash.first = car_at(-2.2, speed_mps);
  crash.second.box.world_from_box.position_m = {0.25, 0, 0.4};
  crash.second.box.half_size_m = {0.25, 20.0, 0.4};
  return crash;
}

}  // namespace septet::debris
