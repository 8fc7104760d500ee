#pragma once
/// The cars of vehicles/ for the tests.

#include <string>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "tests/shipped_files.hpp"
#include "tests/why_not.hpp"

namespace septet::vehicle {

inline std::string vehicle_text(const std::string& name) { return shipped_text("vehicles/" + name + ".toml"); }

inline VehicleParameters read_car(const std::string& name) {
  const auto parameters = read_vehicle(vehicle_text(name), name);
  REQUIRE_MESSAGE(parameters.has_value(), why_not(parameters));
  return *parameters;
}

/// Advances the car for some time with constant controls at 1 kHz.
inline void drive(const VehicleParameters& car, const DriverInput& input, const Ground& ground, double time_s,
                  VehicleState& state) {
  for (int i = 0; i < static_cast<int>(time_s * 1000.0 + 0.5); ++i) advance_vehicle(car, input, ground, 0.001, state);
}

inline Ground sloping_ground(double pitch_rad) {
  Ground ground = level_ground();
  for (WheelGround& wheel : ground) wheel.normal = orientation_from_angles(0.0, pitch_rad, 0.0) * Vec3(0, 0, 1);
  return ground;
}

}  // namespace septet::vehicle
