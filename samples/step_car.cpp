/// Steps a car, without road, traffic or server: full accelerator from rest on level asphalt, then full brake.
///
///     step_car /usr/share/septet/vehicles/volvo-s80.toml
#include <fmt/core.h>

#include "engine/core/regular_file.hpp"
#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/physics/vehicle/vehicle.hpp"

namespace {

constexpr double step_s = 0.001;

/// Steps the car while `speed_mps` is below (above, when braking) the one wanted; prints each second; returns the time that it took.
double drive_until(double wanted_mps, const septet::DriverInput& input,
                   const septet::vehicle::VehicleParameters& parameters, septet::vehicle::VehicleState& car) {
  using namespace septet::vehicle;
  const Ground asphalt = level_ground();
  const bool faster = outputs(parameters, car).speed_mps < wanted_mps;
  for (int step = 0; step < 60'000; ++step) {
    const VehicleOutputs now = outputs(parameters, car);
    if (step % 1000 == 0)
      fmt::print("{:5.1f} s  {:6.1f} km/h  gear {}\n", step * step_s, now.speed_mps * 3.6, now.gear);
    if (faster ? now.speed_mps >= wanted_mps : now.speed_mps <= wanted_mps) return step * step_s;
    advance_vehicle(parameters, input, asphalt, step_s, car);
  }
  return 60.0;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace septet;
  if (argc != 2) {
    fmt::print(stderr, "usage: step_car VEHICLE.toml\n");
    return 2;
  }
  const auto parameters = read_regular_file(argv[1]).and_then(
      [&](const std::string& toml) { return vehicle::read_vehicle(toml, argv[1]); });
  if (!parameters) {
    fmt::print(stderr, "step_car: {}\n", describe(parameters.error()));
    return 1;
  }
  vehicle::VehicleState car = vehicle::standstill(*parameters, RigidTransform{});
  const vehicle::Ground asphalt = vehicle::level_ground();
  for (int step = 0; step < 1500; ++step)
    vehicle::advance_vehicle(*parameters, DriverInput{.brake = 1.0}, asphalt, step_s, car);  // In gear, on the brake.
  const double accelerating_s = drive_until(100.0 / 3.6, DriverInput{.accelerator = 1.0}, *parameters, car);
  const double braking_from_m = vehicle::outputs(*parameters, car).world_from_vehicle.position_m.x;
  drive_until(0.1, DriverInput{.brake = 1.0}, *parameters, car);
  const double braking_m = vehicle::outputs(*parameters, car).world_from_vehicle.position_m.x - braking_from_m;
  fmt::print("0 to 100 km/h in {:.1f} s, and to a stop in {:.1f} m\n", accelerating_s, braking_m);
  return 0;
}
