#pragma once
/// A driver with arbitrary controls.

#include <cmath>

#include "engine/core/random.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

namespace septet::vehicle {

inline DriverInput random_input(Random& random) {
  DriverInput input;
  input.steering_wheel_rad = random.uniform(-10.0, 10.0);
  input.accelerator = random.uniform(-0.5, 1.5);
  input.brake = random.uniform() < 0.5 ? 0.0 : random.uniform();
  input.clutch = random.uniform();
  input.selector = static_cast<GearSelector>(random.below(5));
  input.gear = static_cast<std::int8_t>(static_cast<int>(random.below(9)) - 2);
  input.parking_brake = random.below(4) == 0;
  return input;
}

/// Hills that throw a fast car into the air, with patches of any friction.
inline Ground hilly_ground(const VehicleParameters& car, const VehicleState& state) {
  Ground ground;
  const auto centres_m = wheel_centres_m(car, state);
  for (int i = 0; i < wheel_count; ++i) {
    const double x = centres_m[i].x, y = centres_m[i].y;
    ground[i].point_m = {x, y, 0.5 * std::sin(x / 9.0) + 0.3 * std::sin(y / 6.0)};
    ground[i].normal = glm::normalize(Vec3(-0.5 / 9.0 * std::cos(x / 9.0), -0.3 / 6.0 * std::cos(y / 6.0), 1.0));
    const long patch = std::lround(std::floor(x / 3.0) + 7.0 * std::floor(y / 3.0));
    ground[i].friction = 0.05 + 0.1 * static_cast<double>((patch % 10 + 10) % 10);
  }
  return ground;
}

}  // namespace septet::vehicle
