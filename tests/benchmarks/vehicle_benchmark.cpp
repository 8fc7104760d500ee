// The driver's car at 1 kHz: one simulated second of driving through bends, and with the anti-lock
// system at work.
#include <cmath>
#include <stdexcept>

#include <benchmark/benchmark.h>

#include "engine/physics/vehicle/read_vehicle.hpp"
#include "engine/physics/vehicle/vehicle.hpp"
#include "tests/shipped_files.hpp"

namespace septet::vehicle {
namespace {

const VehicleParameters& volvo_s80() {
  static const VehicleParameters parameters = [] {
    const auto read = read_vehicle(shipped_text("vehicles/volvo-s80.toml"), "volvo-s80.toml");
    if (!read) throw std::runtime_error(describe(read.error()));
    return *read;
  }();
  return parameters;
}

void drive_one_second(benchmark::State& state, const DriverInput& input) {
  const VehicleParameters& car = volvo_s80();
  const Ground ground = level_ground();
  const VehicleState begin = standstill(car, {}, 25.0);
  for (auto _ : state) {
    VehicleState moving = begin;
    for (int i = 0; i < 1000; ++i) advance_vehicle(car, input, ground, 0.001, moving);
    benchmark::DoNotOptimize(moving);
  }
}

void vehicle_second(benchmark::State& state) {
  DriverInput input;
  input.steering_wheel_rad = 0.4;
  input.accelerator = 0.3;
  drive_one_second(state, input);
}
BENCHMARK(vehicle_second)->Unit(benchmark::kMillisecond);

void vehicle_second_braking(benchmark::State& state) {
  DriverInput input;
  input.brake = 1.0;
  drive_one_second(state, input);
}
BENCHMARK(vehicle_second_braking)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace septet::vehicle
