// Outputs of a state, and rigid-body flight and sliding.

#include <cmath>

#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("the origin of a turning car goes round its centre of mass") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 10.0);
  state.angular_velocity_radps = {0.0, 0.0, 0.5};
  state.angular_acceleration_radps2 = {0.0, 0.0, 0.2};
  const VehicleOutputs now = outputs(car, state);
  const double arm_m = car.body.mass_centre_x_m;  // The origin lies behind.
  CHECK(now.velocity_mps.x == doctest::Approx(10.0));
  CHECK(now.velocity_mps.y == doctest::Approx(-0.5 * arm_m));
  CHECK(now.acceleration_mps2.x == doctest::Approx(0.25 * arm_m));  // Towards the centre of mass.
  CHECK(now.acceleration_mps2.y == doctest::Approx(-0.2 * arm_m));
  CHECK(now.yaw_rate_radps == 0.5);
}

TEST_CASE("a car that dives and leans to the right says so and feels its weight") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {Vec3(0.0), orientation_from_angles(0.7, 0.1, 0.0)}, 5.0);
  CHECK(outputs(car, state).pitch_rad == doctest::Approx(0.1));
  CHECK(outputs(car, state).specific_force_mps2.x == doctest::Approx(-gravity_mps2 * std::sin(0.1)));
  state.world_from_body.orientation = orientation_from_angles(0.7, 0.0, 0.08);
  CHECK(outputs(car, state).roll_rad == doctest::Approx(0.08));
  CHECK(outputs(car, state).specific_force_mps2.y == doctest::Approx(gravity_mps2 * std::sin(0.08)));
}

TEST_CASE("sideslip and accelerations are those of ISO 8855") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {Vec3(0.0), orientation_from_angles(0.6, 0.0, 0.0)}, 5.0);
  const Vec3 ahead(std::cos(0.6), std::sin(0.6), 0.0), left(-std::sin(0.6), std::cos(0.6), 0.0);
  state.velocity_mps = 20.0 * ahead + 2.0 * left;
  state.whole_acceleration_mps2 = -3.0 * ahead + 4.0 * left;
  const VehicleOutputs now = outputs(car, state);
  CHECK(now.sideslip_rad == doctest::Approx(std::atan2(2.0, 20.0)));
  CHECK(now.longitudinal_acceleration_mps2 == doctest::Approx(-3.0));
  CHECK(now.lateral_acceleration_mps2 == doctest::Approx(4.0));
  state.velocity_mps = 0.5 * left;
  CHECK(outputs(car, state).sideslip_rad == 0.0);
}

TEST_CASE("after a bad step the steering and what is broken are as they were") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 20.0);
  DriverInput input;
  input.steering_wheel_rad = 0.5;
  drive(car, input, level_ground(), 0.3, state);
  state.wheels[1].damage.lost_air = 0.7;
  const double column_rad = state.steering.column_rad, engine_radps = state.powertrain.engine_radps;
  CHECK(column_rad > 0.4);
  Ground broken = level_ground();
  broken[0].friction = std::nan("");
  advance_vehicle(car, input, broken, 0.001, state);
  CHECK(state.bad_numbers == 1);
  CHECK(state.steering.column_rad == column_rad);
  CHECK(state.powertrain.engine_radps == engine_radps);
  CHECK(state.wheels[1].damage.lost_air == 0.7);
}

TEST_CASE("a car on its roof slides with half its weight as friction") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {Vec3(0.0, 0.0, 1.44), orientation_from_angles(0.0, 0.0, 3.14159265)}, 12.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  drive(car, input, level_ground(), 0.3, state);
  const double before_mps = state.velocity_mps.x;
  drive(car, input, level_ground(), 1.0, state);
  CHECK(before_mps - state.velocity_mps.x == relative(0.5 * gravity_mps2, 0.1));
}

TEST_CASE("a car that pitches and rolls in the air begins to yaw as Euler's equations say and gains no energy") {
  VehicleParameters car = read_car("volvo-s80");
  car.body.drag_area_m2 = 0.0;
  car.body.lift_area_m2 = {0.0, 0.0};
  VehicleState state = standstill(car, {Vec3(0.0, 0.0, 40.0), Quat(1, 0, 0, 0)}, 20.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  drive(car, input, level_ground(), 1.0, state);  // The springs come to rest.
  state.angular_velocity_radps = {1.0, 1.5, 0.0};
  const double start_j = mechanical_energy_j(car, state);
  advance_vehicle(car, input, level_ground(), 0.001, state);
  const Vec3& inertia = car.body.inertia_kgm2;
  CHECK(state.angular_acceleration_radps2.z == relative((inertia.x - inertia.y) * 1.0 * 1.5 / inertia.z, 0.02));
  // The wheels swing out against their dampers; a step errs by its fall.
  for (int i = 0; i < 40; ++i) {
    drive(car, input, level_ground(), 0.01, state);
    CHECK(mechanical_energy_j(car, state) < start_j + 0.01 * car.body.mass_kg * gravity_mps2);
  }
}

TEST_CASE("the tyre's aligning torque is its trail of the contact's length") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 20.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  input.steering_wheel_rad = 0.08;
  drive(car, input, level_ground(), 2.0, state);
  for (const int wheel : {0, 1}) {
    const WheelState& front = state.wheels[wheel];
    // A chord of the tyre's circle.
    const double length_m = 2.0 * std::sqrt(2.0 * car.tyre.radius_m * front.squeeze_m);
    const double slip = std::abs(std::tan(front.slip_angle_rad)) / car.tyre.load_sensitive.trail_zero_slip;
    REQUIRE(slip < 0.15);
    CHECK(-front.aligning_nm / front.force_n.y == relative(car.tyre.load_sensitive.trail_over_length * length_m, 0.1));
  }
}
