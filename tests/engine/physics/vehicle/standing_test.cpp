#include <doctest/doctest.h>

#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("a car at rest stays where it is and its wheels carry its weight") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {});
  DriverInput input;
  input.selector = GearSelector::neutral;
  drive(car, input, level_ground(), 5.0, state);
  const VehicleOutputs now = outputs(car, state);
  CHECK(glm::length(now.world_from_vehicle.position_m) < 1e-6);
  CHECK(glm::length(now.velocity_mps) < 1e-6);
  double load_n = 0.0;
  for (const double wheel_n : now.wheel_load_n) load_n += wheel_n;
  CHECK(load_n == relative(car.body.mass_kg * gravity_mps2, 1e-6));
}

TEST_CASE("brakes hold the car on a slope without creep and without jitter") {
  const VehicleParameters car = read_car("volvo-s80");
  const RigidTransform downhill{Vec3(0.0), orientation_from_angles(0.0, 0.15, 0.0)};
  VehicleState state = standstill(car, downhill);
  DriverInput input;
  input.brake = 0.6;
  drive(car, input, sloping_ground(0.15), 5.0, state);  // The body settles on springs and tyres.
  const Vec3 settled_m = state.world_from_body.position_m;
  double fastest_mps = 0.0;
  for (int i = 0; i < 20000; ++i) {
    advance_vehicle(car, input, sloping_ground(0.15), 0.001, state);
    fastest_mps = std::max(fastest_mps, glm::length(state.velocity_mps));
  }
  CHECK(fastest_mps < 1e-3);
  CHECK(glm::length(state.world_from_body.position_m - settled_m) < 1e-3);
}

TEST_CASE("the parking brake and the pawl each hold the car on a slope") {
  const VehicleParameters car = read_car("volvo-s80");
  const RigidTransform downhill{Vec3(0.0), orientation_from_angles(0.0, 0.12, 0.0)};
  for (const bool pawl : {false, true}) {
    VehicleState state = standstill(car, downhill);
    DriverInput input;
    input.selector = pawl ? GearSelector::park : GearSelector::neutral;
    input.parking_brake = !pawl;
    drive(car, input, sloping_ground(0.12), 10.0, state);
    CHECK(glm::length(state.world_from_body.position_m - standstill(car, downhill).world_from_body.position_m) < 0.05);
    CHECK(glm::length(state.velocity_mps) < 1e-3);
  }
}

TEST_CASE("the automatic creeps off at idle and rolls back in neutral") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState creeping = standstill(car, {});
  drive(car, {}, level_ground(), 15.0, creeping);
  CHECK(outputs(car, creeping).speed_mps > 1.0);
  CHECK(outputs(car, creeping).speed_mps < 3.5);

  const RigidTransform uphill{Vec3(0.0), orientation_from_angles(0.0, -0.1, 0.0)};
  VehicleState rolling = standstill(car, uphill);
  DriverInput neutral;
  neutral.selector = GearSelector::neutral;
  drive(car, neutral, sloping_ground(-0.1), 3.0, rolling);
  CHECK(outputs(car, rolling).speed_mps < -2.0);
}

TEST_CASE("a full stop from speed ends at rest") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 30.0);
  DriverInput input;
  input.brake = 1.0;
  drive(car, input, level_ground(), 8.0, state);
  CHECK(std::abs(outputs(car, state).speed_mps) < 2e-3);
}
