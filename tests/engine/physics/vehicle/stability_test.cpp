#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/controls.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/engine/physics/vehicle/hostile_driving.hpp"
#include "tests/engine/physics/vehicle/mechanical_energy.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {
constexpr double kmph = 1.0 / 3.6;

/// Braked hard from 25 m/s with ice under the right wheels.
VehicleState braked_on_split_friction(const VehicleParameters& car, double time_s) {
  VehicleState state = standstill(car, {}, 25.0);
  Ground ground = level_ground();
  ground[1].friction = ground[3].friction = 0.1;
  DriverInput input;
  input.brake = 1.0;
  drive(car, input, ground, time_s, state);
  return state;
}
}  // namespace

TEST_CASE("the car runs straight and true at 250 km/h and in reverse") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const double speed_mps : {250.0 * kmph, 100.0 * kmph, -30.0 * kmph, -250.0 * kmph}) {
    CAPTURE(speed_mps);
    VehicleState state = standstill(car, {}, speed_mps);
    DriverInput input;
    input.selector = GearSelector::neutral;
    drive(car, input, level_ground(), 5.0, state);
    const VehicleOutputs now = outputs(car, state);
    CHECK(now.speed_mps / speed_mps > 0.85);
    CHECK(std::abs(now.world_from_vehicle.position_m.y) < 0.05);
    CHECK(std::abs(now.yaw_rate_radps) < 1e-3);
    CHECK(state.bad_numbers == 0);
  }
}

TEST_CASE("the car drives off and stops on ice without a bad number") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {});
  DriverInput input;
  input.accelerator = 1.0;
  drive(car, input, level_ground(0.0, 0.1), 15.0, state);
  const double speed_mps = outputs(car, state).speed_mps;
  CHECK(speed_mps > 3.0);
  CHECK(speed_mps < 0.1 / 0.9 * 1.05 * gravity_mps2 * 15.0);  // No more than the ice can give.
  input.accelerator = 0.0;
  input.brake = 1.0;
  drive(car, input, level_ground(0.0, 0.1), 20.0, state);
  CHECK(std::abs(outputs(car, state).speed_mps) < 0.01);
  CHECK(state.bad_numbers == 0);
}

TEST_CASE("a car in the air falls freely and lands on its wheels") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {Vec3(0.0, 0.0, 0.3), Quat(1, 0, 0, 0)}, 20.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  // The springs push body and wheels apart, so the fall is that of the centre of the whole car.
  const auto whole_height_m = [&] {
    double height_m = state.world_from_body.position_m.z;
    for (std::size_t wheel = 0; wheel < wheel_count; ++wheel)
      height_m += car.suspension[wheel / 2].unsprung_mass_kg / car.body.mass_kg * state.wheels[wheel].travel_m;
    return height_m;
  };
  const double from_m = whole_height_m();
  drive(car, input, level_ground(), 0.15, state);
  for (const double load_n : outputs(car, state).wheel_load_n) CHECK(load_n == 0.0);
  CHECK(std::abs(from_m - whole_height_m() - 0.5 * gravity_mps2 * 0.15 * 0.15) < 0.005);
  CHECK(std::abs(state.whole_acceleration_mps2.z + gravity_mps2) < 0.1);  // Air lifts a little.
  drive(car, input, level_ground(), 5.0, state);
  CHECK(outputs(car, state).world_from_vehicle.position_m.z == doctest::Approx(0.0).epsilon(0.01));
  CHECK(outputs(car, state).speed_mps > 17.0);
}

TEST_CASE("a car on its roof comes to rest above the ground") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {Vec3(0.0, 0.0, 2.0), orientation_from_angles(0, 0, 3.0)}, 5.0);
  DriverInput input;
  input.selector = GearSelector::neutral;
  drive(car, input, level_ground(), 10.0, state);
  CHECK(state.world_from_body.position_m.z > 0.2);
  CHECK(glm::length(state.velocity_mps) < 0.5);
  CHECK(state.bad_numbers == 0);
}

TEST_CASE("on split friction the braked car turns towards the side that grips") {
  VehicleParameters car = read_car("volvo-s80");
  car.brakes.stability_control = false;
  CHECK(outputs(car, braked_on_split_friction(car, 1.0)).yaw_rate_radps > 0.02);
}

TEST_CASE("on split friction the anti-lock system turns the braked car less than locked wheels do") {
  const auto heading_after = [](bool anti_lock) {
    VehicleParameters car = read_car("volvo-s80");
    car.brakes.stability_control = false;
    car.brakes.anti_lock = anti_lock;
    return std::abs(heading_rad(braked_on_split_friction(car, 1.5).world_from_body.orientation));
  };
  const double with = heading_after(true), without = heading_after(false);
  CAPTURE(with);
  CAPTURE(without);
  // With the rear wheels braked alike (select low) the rear axle keeps its grip sideways: 0.43 of
  // the locked wheels' turn. With each rear wheel at its own peak the grip of one side turned the
  // car and the other had none left to hold it: 0.80.
  CHECK(with < 0.6 * without);
}

TEST_CASE("a number that is not finite is undone and counted and the car stands still") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 20.0);
  drive(car, {}, level_ground(), 0.1, state);
  const Vec3 place_m = state.world_from_body.position_m;
  Ground broken = level_ground();
  broken[2].point_m.z = std::numeric_limits<double>::quiet_NaN();
  advance_vehicle(car, {}, broken, 0.001, state);
  CHECK(state.bad_numbers == 1);
  CHECK(state.world_from_body.position_m == place_m);
  CHECK(glm::length(state.velocity_mps) == 0.0);
  DriverInput wild;
  wild.steering_wheel_rad = std::numeric_limits<double>::infinity();
  wild.brake = std::numeric_limits<double>::quiet_NaN();
  drive(car, wild, level_ground(), 1.0, state);
  CHECK(state.bad_numbers == 1);
}

TEST_CASE("the same inputs give the same bits") {
  const VehicleParameters car = read_car("volvo-s80");
  const auto run = [&] {
    Random random(7);
    VehicleState state = standstill(car, {}, 20.0);
    for (int i = 0; i < 200; ++i) drive(car, random_input(random), level_ground(), 0.05, state);
    StateHash hash;
    hash_state(hash, state);
    return hash.value();
  };
  CHECK(run() == run());
}

TEST_CASE("no energy comes from nothing while the driver steers and brakes out of gear") {
  VehicleParameters car = read_car("volvo-s80");
  car.brakes.stability_control = false;
  Random random(11);
  for (int drive_number = 0; drive_number < 8; ++drive_number) {
    VehicleState state = standstill(car, {}, random.uniform(-20.0, 60.0));
    const Ground ground = level_ground(0.0, random.uniform(0.05, 1.0));
    const double start_j = mechanical_energy_j(car, state);
    double least_j = start_j;
    for (int i = 0; i < 40; ++i) {
      DriverInput input = random_input(random);
      input.selector = GearSelector::neutral;
      drive(car, input, ground, 0.1, state);
      const double now_j = mechanical_energy_j(car, state);
      CAPTURE(i);
      // The hand wheel does a little work against the tyres.
      CHECK(now_j < least_j + 0.01 * std::abs(start_j) + 150.0);
      least_j = std::min(least_j, now_j);
    }
    CHECK(state.bad_numbers == 0);
  }
}

namespace {

constexpr double degrees = 57.29577951308232;
constexpr double high_side = 0.9, low_side = 0.1;

struct SplitStop {
  double heading_deg = 0.0, aside_m = 0.0;  ///< Greatest.
  double developed_mps2 = 0.0;              ///< Mean fully developed deceleration, from 80 to 10 % of the speed.
  double wheel_2_s_deg = 0.0,
         wheel_deg = 0.0;  ///< Greatest turn of the hand wheel in the first two seconds, and in all.
};

/// Full brake, left wheels on the high side and right ones on the low side, for `time_s` or to 1 km/h. The driver takes
/// half a second to see it, then steers against heading, way aside and yaw rate with a lag of 0.1 s and at most 400
/// deg/s.
SplitStop split_stop(double speed_mps, bool stability_control, bool hands_on, double time_s) {
  VehicleParameters car = read_car("volvo-s80");
  car.brakes.stability_control = stability_control;
  VehicleState state = standstill(car, {}, speed_mps);
  Ground ground = level_ground();
  for (int i = 0; i < wheel_count; ++i) ground[i].friction = i % 2 == 0 ? high_side : low_side;
  DriverInput input;
  input.brake = 1.0;
  SplitStop result;
  double from_80_m = 0.0, from_10_m = 0.0;
  for (int i = 0; i < static_cast<int>(time_s * 1000.0); ++i) {
    const VehicleOutputs now = outputs(car, state);
    const Vec3 forward = state.world_from_body.orientation * Vec3(1, 0, 0), place_m = state.world_from_body.position_m;
    const double heading = std::atan2(forward.y, forward.x);
    if (hands_on && i >= 500) {
      const double wanted = -6.0 * (heading + 0.06 * place_m.y) - 3.0 * now.yaw_rate_radps;
      input.steering_wheel_rad += 0.001 * std::clamp((wanted - input.steering_wheel_rad) / 0.1, -7.0, 7.0);
    }
    advance_vehicle(car, input, ground, 0.001, state);
    const double wheel_deg = std::abs(input.steering_wheel_rad) * degrees;
    result.wheel_deg = std::max(result.wheel_deg, wheel_deg);
    if (i < 2000) result.wheel_2_s_deg = std::max(result.wheel_2_s_deg, wheel_deg);
    result.heading_deg = std::max(result.heading_deg, std::abs(heading) * degrees);
    result.aside_m = std::max(result.aside_m, std::abs(place_m.y));
    if (now.speed_mps > 0.8 * speed_mps) from_80_m = place_m.x;
    if (now.speed_mps > 0.1 * speed_mps) from_10_m = place_m.x;
    if (now.speed_mps < 1.0 / 3.6) break;
  }
  result.developed_mps2 = (0.64 - 0.01) * speed_mps * speed_mps / (2.0 * std::max(from_10_m - from_80_m, 1e-9));
  return result;
}

}  // namespace

TEST_CASE(
    "braked on split friction with the hands off the car stays in its lane for two seconds with stability control and "
    "not without") {
  constexpr double beside_the_car_m = 0.5 * (3.5 - 1.83);
  for (const double speed_kmph : {50.0, 100.0}) {
    CAPTURE(speed_kmph);
    const SplitStop without = split_stop(speed_kmph / 3.6, false, false, 2.0),
                    with = split_stop(speed_kmph / 3.6, true, false, 2.0);
    CHECK(with.aside_m < beside_the_car_m);
    CHECK(with.heading_deg < 3.0);
    CHECK(without.heading_deg > 20.0);
  }
}

TEST_CASE(
    "braked on split friction a driver holds the car in its lane with little steering and it decelerates as UN R13-H "
    "asks") {
  // UN Regulation No. 13-H, annex 6, 5.3.6: from 50 km/h; 120 degrees in the first two seconds, 240 in all.
  const SplitStop stop = split_stop(50.0 / 3.6, true, true, 15.0);
  CHECK(stop.developed_mps2 > 0.75 * (4.0 * low_side + high_side) / 5.0 * gravity_mps2);
  CHECK(stop.developed_mps2 > low_side * gravity_mps2);
  CHECK(stop.wheel_2_s_deg < 120.0);
  CHECK(stop.wheel_deg < 240.0);
  CHECK(stop.aside_m < 0.83);
  const SplitStop fast = split_stop(100.0 / 3.6, true, true, 15.0);
  CHECK(fast.wheel_2_s_deg < 120.0);
  CHECK(fast.wheel_deg < 240.0);
  CHECK(fast.heading_deg < 10.0);
}

TEST_CASE("stability control has braked the outer front wheel a tenth of a second after the car turns too much") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const double yaw_radps : {1.0, -1.0}) {
    VehicleState state = standstill(car, {}, 25.0);
    state.angular_velocity_radps.z = yaw_radps;
    std::array<double, wheel_count> torque_nm{};
    for (int i = 0; i < 100; ++i) torque_nm = advance_brakes(car, {}, {25.0, 0.0, 0.0}, 0.001, state);
    const int outer = yaw_radps > 0.0 ? 1 : 0;
    CHECK(state.brakes.stabilising[outer] > 0.5);
    CHECK(torque_nm[1 - outer] < 0.05 * car.brakes.full_torque_nm[0]);
  }
}

TEST_CASE("each braking on split friction begins with the delay of its yaw moment") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState state = standstill(car, {}, 25.0);
  state.brakes.front_difference = 1.0;  // Of a braking that is over.
  for (int i = 0; i < 2000; ++i) advance_brakes(car, {}, {25.0, 0.0, 0.0}, 0.001, state);
  CHECK(state.brakes.front_difference < 0.05);
}
