// Failures of the car itself: the brakes' control, a cylinder, a tyre.

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/faults.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

namespace septet::vehicle {
namespace {

VehicleState driven(const VehicleParameters& car, VehicleState state, const DriverInput& input, double time_s) {
  const Ground ground = level_ground();
  for (int i = 0; i < static_cast<int>(time_s * 960.0); ++i) advance_vehicle(car, input, ground, 1.0 / 960.0, state);
  CHECK(state.bad_numbers == 0);
  return state;
}

DriverInput with_pedals(double accelerator, double brake) {
  DriverInput input;
  input.selector = GearSelector::drive;
  input.accelerator = accelerator;
  input.brake = brake;
  return input;
}

}  // namespace

TEST_CASE("without the anti-lock system hard braking locks the wheels, and the way to a stop is longer") {
  const VehicleParameters car = read_car("volvo-s80"), failed = with_faults(car, {.anti_lock = true});
  const auto braked = [](const VehicleParameters& parameters) {
    return driven(parameters, standstill(parameters, {}, 25.0), with_pedals(0.0, 1.0), 1.0);
  };
  const VehicleState whole = braked(car), locked = braked(failed);
  const auto slowest = [](const VehicleState& state) {
    return std::ranges::min_element(state.wheels, {}, &WheelState::spin_radps)->spin_radps;
  };
  CHECK(slowest(whole) > 20.0);
  CHECK(std::abs(slowest(locked)) < 1.0);
  CHECK(outputs(failed, locked).speed_mps > outputs(car, whole).speed_mps + 0.5);
  CHECK_FALSE(outputs(failed, locked).anti_lock_active);
}

TEST_CASE("a control that switches itself off while it acts lets the pedal have all of the pressure") {
  const VehicleParameters car = read_car("volvo-s80"), failed = with_faults(car, {.anti_lock = true});
  VehicleState state = driven(car, standstill(car, {}, 25.0), with_pedals(0.0, 1.0), 0.5);
  REQUIRE(*std::ranges::max_element(state.brakes.release) > 0.1);
  release_controls(state);
  state = driven(failed, state, with_pedals(0.0, 1.0), 0.5);
  CHECK(*std::ranges::max_element(state.brakes.release) == 0.0);
  for (const WheelState& wheel : state.wheels) CHECK(std::abs(wheel.spin_radps) < 1.0);
}

TEST_CASE("a misfire of one cylinder of six costs a sixth of the drive at full throttle and nothing when coasting") {
  const VehicleParameters car = read_car("volvo-s80"), failed = with_faults(car, {.misfire = true});
  REQUIRE(car.powertrain.cylinders == 6);
  const Table &whole_nm = car.powertrain.full_torque_nm, &failed_nm = failed.powertrain.full_torque_nm;
  for (std::size_t i = 0; i < whole_nm.count; ++i) {
    const double dragged_nm = car.powertrain.closed_torque_nm.held(whole_nm.x[i]);
    CHECK(failed_nm.y[i] - dragged_nm == relative(5.0 / 6.0 * (whole_nm.y[i] - dragged_nm), 1e-12));
  }
  const auto end_mps = [](const VehicleParameters& parameters, double accelerator) {
    return outputs(parameters, driven(parameters, standstill(parameters, {}, 15.0), with_pedals(accelerator, 0.0), 3.0))
        .speed_mps;
  };
  const double gain_mps = end_mps(car, 1.0) - 15.0, failed_gain_mps = end_mps(failed, 1.0) - 15.0;
  CHECK(failed_gain_mps < 0.9 * gain_mps);
  CHECK(failed_gain_mps > 0.6 * gain_mps);
  CHECK(end_mps(failed, 0.0) == relative(end_mps(car, 0.0), 0.01));
}

TEST_CASE("a punctured tyre is flat within seconds and drags the car to its side, and another one rolls straight") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 20.0);
  puncture(state.wheels[0]);
  state = driven(car, state, with_pedals(0.0, 0.0), 4.0);
  CHECK(state.wheels[0].damage.lost_air > 0.9);
  CHECK(outputs(car, state).world_from_vehicle.position_m.y > 0.5);
  change_tyre(state.wheels[0]);
  CHECK_FALSE(state.wheels[0].damage.any());
}

TEST_CASE("without a fault the car is the same") {
  const VehicleParameters car = read_car("volvo-s80"), same = with_faults(car, {});
  const auto hash_of = [](const VehicleParameters& parameters) {
    StateHash hash;
    hash_state(hash, driven(parameters, standstill(parameters, {}, 20.0), with_pedals(0.5, 0.0), 1.0));
    return hash.value();
  };
  CHECK(hash_of(car) == hash_of(same));
}

}  // namespace septet::vehicle
