// From the engine to the wheels.

#include <algorithm>
#include <cmath>
#include <vector>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/controls.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

/// Torque at the wheels over the torque passed through clutch and gears, after a second of driving with this
/// accelerator.
double wheel_share(double accelerator) {
  VehicleParameters car = read_car("volvo-s80");
  car.powertrain.transmission = Transmission::manual;
  VehicleState state = standstill(car, {}, 20.0);
  DriverInput input;
  input.selector = GearSelector::manual;
  input.gear = state.powertrain.gear;
  input.accelerator = accelerator;
  drive(car, input, level_ground(), 2.0, state);
  double sum_nm = 0.0;
  const double gearing = car.powertrain.gear_ratio[state.powertrain.gear - 1] * car.powertrain.final_ratio;
  const double clutch_nm = state.powertrain.clutch_nm;
  for (const double torque_nm : advance_powertrain(car, input, state.velocity_mps.x, 0.001, state)) sum_nm += torque_nm;
  CHECK(sum_nm * accelerator >= 0.0);
  return sum_nm / (clutch_nm * gearing);
}

}  // namespace

TEST_CASE("the gears lose their share when the engine drives and when the car drags it") {
  const double efficiency = read_car("volvo-s80").powertrain.efficiency;
  CHECK(wheel_share(0.5) == relative(efficiency, 0.02));
  CHECK(wheel_share(0.0) == relative(1.0 / efficiency, 0.02));
}

TEST_CASE("the automatic takes its time between two changes of gear and gives less torque during one") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 22.0);
  DriverInput input;
  input.accelerator = 0.1;
  drive(car, input, level_ground(), 1.0, state);
  input.accelerator = 1.0;
  std::vector<double> changes_s;
  double torque_before_nm = 0.0, least_nm = 1e9;
  for (int i = 0; i < 6000; ++i) {
    const int before = state.powertrain.gear;
    const bool shifting = state.powertrain.next_gear != before;
    drive(car, input, level_ground(), 0.001, state);
    if (state.powertrain.gear != before) changes_s.push_back(0.001 * i);
    // Once the lag of the manifold is over.
    if (shifting && state.powertrain.shift_s > 0.35) least_nm = std::min(least_nm, state.powertrain.engine_torque_nm);
    if (!shifting && state.powertrain.since_shift_s > 0.5)
      torque_before_nm = std::max(torque_before_nm, state.powertrain.engine_torque_nm);
  }
  REQUIRE(changes_s.size() >= 2);
  for (std::size_t i = 1; i < changes_s.size(); ++i)
    CHECK(changes_s[i] - changes_s[i - 1] > 0.7 + car.powertrain.shift_time_s - 0.01);
  CHECK(least_nm < 0.9 * torque_before_nm);
}

TEST_CASE("at no pedal and speed does the automatic hunt between two gears") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const double accelerator : {0.15, 0.3, 0.5, 0.8, 1.0})
    for (const double speed_mps : {6.0, 12.0, 18.0, 25.0, 35.0}) {
      CAPTURE(accelerator);
      CAPTURE(speed_mps);
      VehicleState state = standstill(car, {}, speed_mps);
      DriverInput input;
      input.accelerator = accelerator;
      int turns = 0, last = 0, way = 0;
      for (int i = 0; i < 80; ++i) {
        drive(car, input, level_ground(), 0.05, state);
        const int gear = state.powertrain.gear;
        if (last != 0 && gear != last) {
          turns += way != 0 && (gear > last) != (way > 0);
          way = gear - last;
        }
        last = gear;
      }
      CHECK(turns <= 1);  // A kick-down, and up again at full speed.
    }
}
