// The S80's figures: published data, and general properties of a car.

#include <algorithm>
#include <array>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/manoeuvre.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("the S80 understeers like a car") {
  const ManoeuvreReport report = steady_circle(read_car("volvo-s80"), {});
  CHECK(report.figure("understeer gradient") > 2.0);
  CHECK(report.figure("understeer gradient") < 4.8);
  CHECK(report.figure("roll gradient") > 3.0);
  CHECK(report.figure("roll gradient") < 7.0);
  CHECK(report.figure("peak lateral acceleration") > 7.0);
  CHECK(report.figure("peak lateral acceleration") < 9.0);
  CHECK(report.figure("hand wheel torque at 4 m/s2") < -1.5);  // Pulls straight.
}

TEST_CASE("the S80 reaches 60 mph in about nine seconds and runs about 140 mph") {
  const ManoeuvreReport report = acceleration(read_car("volvo-s80"), {});
  CHECK(report.figure("0-60 mph") == relative(9.0, 0.5 / 9.0));
  CHECK(report.figure("top speed in mph") == relative(140.0, 0.05));
}

TEST_CASE("the S80 rolls out against drag and rolling resistance") {
  const VehicleParameters car = read_car("volvo-s80");
  const ManoeuvreReport report = coast_down(car, {});
  // Drag and rolling resistance by hand; the wheels' inertia adds some per cent to the mass.
  const auto expected = [&](double speed_mps) {
    const double drag_n = 0.5 * 1.225 * car.body.drag_area_m2 * speed_mps * speed_mps;
    const double rolling = car.tyre.rolling_resistance + car.tyre.rolling_resistance_s2pm2 * speed_mps * speed_mps;
    return drag_n / car.body.mass_kg + rolling * gravity_mps2;
  };
  CHECK(report.figure("deceleration at 100 km/h") == relative(expected(100.0 / 3.6), 0.06));
  CHECK(report.figure("deceleration at 50 km/h") == relative(expected(50.0 / 3.6), 0.06));
}

TEST_CASE("the anti-lock system stops the S80 within what the surface allows") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const double friction : {0.9, 0.55, 0.28, 0.10}) {
    CAPTURE(friction);
    ManoeuvreOptions options;
    options.friction = friction;
    const double distance_m = stop(car, options).figure("stopping distance");
    const double peak = friction / 0.9 * 1.02;  // Of the tyre at its nominal load.
    const double speed_mps = 100.0 / 3.6;
    const double shortest_m = speed_mps * speed_mps / (2.0 * peak * gravity_mps2);
    CHECK(distance_m > 0.98 * shortest_m);
    CHECK(distance_m < 1.35 * shortest_m + 3.0);
  }
}

TEST_CASE("the stability control keeps the S80 on its way through a sine with dwell") {
  const VehicleParameters car = read_car("volvo-s80");
  const ManoeuvreReport report = sine_with_dwell(car, {});
  // Limits of ISO 19365's companion regulation (UN R140): 35 % and 20 % of the peak, 1.83 m aside.
  CHECK(std::abs(report.figure("yaw rate ratio after 1 s")) < 35.0);
  CHECK(std::abs(report.figure("yaw rate ratio after 1.75 s")) < 20.0);
  CHECK(report.figure("lateral displacement at 1.07 s") > 1.83);
  ManoeuvreOptions without;
  without.stability_control = false;
  CHECK(sine_with_dwell(car, without).figure("peak sideslip") > report.figure("peak sideslip"));
}

TEST_CASE("at 200 km/h each axle is lightened by the lift of its own area") {
  VehicleParameters car = read_car("volvo-s80");
  car.body.drag_area_m2 = 0.0;  // Only lift, on a car that rolls freely.
  VehicleParameters without = car;
  without.body.lift_area_m2 = {0.0, 0.0};
  // Unequal, since a lift's moment loads its own axle alone.
  car.body.lift_area_m2 = {0.3, 0.1};
  constexpr double speed_mps = 200.0 / 3.6;
  DriverInput input;
  input.selector = GearSelector::neutral;
  const auto axle_loads_n = [&](const VehicleParameters& tested) {
    VehicleState state = standstill(tested, {}, speed_mps);
    drive(tested, input, level_ground(), 4.0, state);
    const VehicleOutputs now = outputs(tested, state);
    return std::array{now.wheel_load_n[0] + now.wheel_load_n[1], now.wheel_load_n[2] + now.wheel_load_n[3],
                      now.speed_mps};
  };
  const auto lifted = axle_loads_n(car), resting = axle_loads_n(without);
  const double pressure_pa = 0.5 * 1.225 * lifted[2] * lifted[2];
  for (int axle = 0; axle < axle_count; ++axle)
    CHECK(resting[axle] - lifted[axle] == relative(pressure_pa * car.body.lift_area_m2[axle], 0.08));
}

TEST_CASE("started with full throttle on ice the driven wheels turn no faster than the traction control lets them") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {});
  DriverInput input;
  input.accelerator = 1.0;
  double most_mps = 0.0, sum_mps = 0.0;
  constexpr int steps = 6000, from = 2000;
  for (int i = 0; i < steps; ++i) {
    advance_vehicle(car, input, level_ground(0.0, 0.1), 0.001, state);
    if (i < from) continue;
    const double over_mps = 0.5 * (state.wheels[0].spin_radps + state.wheels[1].spin_radps) * car.tyre.radius_m * 0.98 -
                            outputs(car, state).speed_mps;
    most_mps = std::max(most_mps, over_mps);
    sum_mps += over_mps;
  }
  MESSAGE("driven wheels over the road: mean " << sum_mps / (steps - from) << " m/s, at most " << most_mps);
  CHECK(outputs(car, state).speed_mps > 2.0);
  CHECK(sum_mps / (steps - from) < 2.3);
}
