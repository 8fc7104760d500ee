// Wheel loads must balance the car's motion.

#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/suspension.hpp"
#include "tests/engine/physics/vehicle/car.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE(
    "a braked car's axles carry what balances weight and deceleration about its mass centre, however far its nose "
    "dips") {
  VehicleParameters car = read_car("volvo-s80");
  car.body.drag_area_m2 = 0.0;
  car.body.lift_area_m2 = {};
  car.tyre.rolling_resistance = car.tyre.rolling_resistance_s2pm2 = 0.0;
  VehicleState state = standstill(car, {}, 35.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  input.brake = 0.35;
  drive(car, input, level_ground(), 2.5, state);
  const VehicleOutputs now = outputs(car, state);
  REQUIRE(now.longitudinal_acceleration_mps2 < -3.0);
  REQUIRE(now.pitch_rad > 0.01);
  REQUIRE(std::abs(now.angular_velocity_radps.y) < 0.002);

  const Vec3 mass_centre_m = state.world_from_body.position_m;
  const auto centres_m = wheel_centres_m(car, state);
  // Loads stand under the wheels' centres; the unsprung masses weigh and decelerate where they are, and the wheels'
  // spin falls.
  double moment_nm = 0.0, forces_nm = 0.0;
  for (int i = 0; i < wheel_count; ++i) {
    const Vec3 arm_m = centres_m[i] - mass_centre_m;
    const SuspensionParameters& axle = car.suspension[axle_of(i)];
    const double weight_n = axle.unsprung_mass_kg * gravity_mps2;
    const double inertia_n = axle.unsprung_mass_kg * now.longitudinal_acceleration_mps2;
    const double spin_nm = axle.wheel_inertia_kgm2 * now.longitudinal_acceleration_mps2 / car.tyre.radius_m;
    moment_nm += arm_m.x * (state.wheels[i].force_n.z - weight_n);
    moment_nm += mass_centre_m.z * state.wheels[i].force_n.x + arm_m.z * inertia_n + spin_nm;
    forces_nm += mass_centre_m.z * state.wheels[i].force_n.x;
  }
  CHECK(std::abs(moment_nm) < 0.005 * std::abs(forces_nm));  // With contacts that dip with the body: 0.018.
}

TEST_CASE("the sideways forces of a rigid axle's wheels lean it and do not lift it") {
  VehicleParameters car = read_car("commonroad-escort");
  car.as_published = false;
  VehicleState state = standstill(car, {}, 22.0);
  ChassisInput input;
  input.steer_rad = -0.02;
  for (int i = 0; i < 4000; ++i)
    advance_chassis(car, input, level_ground(0.0, car.tyre.reference_friction), 0.001, state);
  REQUIRE(std::abs(outputs(car, state).lateral_acceleration_mps2) > 3.0);

  const Statics known = statics(car);
  const Quat& world_from_body = state.world_from_body.orientation;
  const Vec3 body_up = world_from_body * Vec3(0.0, 0.0, 1.0);
  const double heading_rad =
      std::atan2((world_from_body * Vec3(1.0, 0.0, 0.0)).y, (world_from_body * Vec3(1.0, 0.0, 0.0)).x);
  const Vec3 left(-std::sin(heading_rad), std::cos(heading_rad), 0.0);
  const double felt_mps2 = glm::dot(state.acceleration_mps2 + Vec3(0.0, 0.0, gravity_mps2), body_up);
  for (int axle = 0; axle < axle_count; ++axle) {
    double spring_n = 0.0, tyre_n = 0.0;
    for (int i = 2 * axle; i < 2 * axle + 2; ++i) {
      const Vec3& force_n = state.wheels[i].force_n;
      spring_n += suspension_force_n(car, known, i, state.wheels);
      tyre_n += glm::dot(force_n.y * left + Vec3(0.0, 0.0, force_n.z), body_up);
      tyre_n -= car.suspension[axle].unsprung_mass_kg * felt_mps2;
    }
    CAPTURE(axle);
    CHECK(std::abs(tyre_n - spring_n) < 0.001 * spring_n);  // With a joint for each wheel: 0.003 to 0.005.
  }
}
