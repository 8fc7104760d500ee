// A wheel is pressed down to its rim: by the edge of a kerb, out of a hole, after a jump.

#include <algorithm>
#include <array>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/tyre.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

namespace {

/// Ground that lies higher by `height_m` (lower where negative) between two places of the x axis, under the wheels of
/// both sides or of one.
struct Step {
  double height_m = 0.0;
  double from_m = 6.0, to_m = 1e6;
  bool left = true, right = true;
};

/// Rolls over the step with the hand wheel held straight; the ground is looked up at 120 Hz.
void roll_over(const VehicleParameters& car, const Step& step, double time_s, VehicleState& state) {
  DriverInput input;
  input.selector = GearSelector::neutral;
  Ground ground = level_ground();
  const int steps = static_cast<int>(time_s * 960.0);
  for (int i = 0; i < steps; ++i) {
    if (i % 8 == 0) {
      const auto centres = wheel_centres_m(car, state);
      for (int wheel = 0; wheel < wheel_count; ++wheel) {
        const Vec3& centre = centres[wheel];
        const bool meets = wheel % 2 == 0 ? step.left : step.right;
        const bool inside = meets && centre.x > step.from_m && centre.x < step.to_m;
        ground[wheel].point_m = {centre.x, centre.y, inside ? step.height_m : 0.0};
        ground[wheel].edges = {};
        for (std::size_t edge = 0; edge < 2; ++edge) {
          const double edge_x_m = edge == 0 ? step.from_m : step.to_m;
          if (meets && std::abs(centre.x - edge_x_m) < car.tyre.radius_m)
            ground[wheel].edges[edge] = {.point_m = Vec3(edge_x_m, centre.y, std::max(step.height_m, 0.0))};
        }
      }
    }
    advance_vehicle(car, input, ground, 1.0 / 960.0, state);
  }
  CHECK(state.bad_numbers == 0);
}

VehicleState rolled_over(const VehicleParameters& car, const Step& step, double speed_mps, double time_s) {
  VehicleState state = standstill(car, {}, speed_mps);
  roll_over(car, step, time_s, state);
  return state;
}

std::uint64_t hash_of(const VehicleState& state) {
  StateHash hash;
  hash_state(hash, state);
  return hash.value();
}

constexpr Step road{.from_m = 1e5};

}  // namespace

TEST_CASE("a kerb of 12 cm struck square at 15 m/s cuts the front tyres and bends their rims and at 2 m/s none") {
  const VehicleParameters car = read_car("volvo-s80");
  const VehicleState fast = rolled_over(car, {.height_m = 0.12}, 15.0, 1.0);
  for (const int wheel : {0, 1}) {
    CHECK(fast.wheels[wheel].damage.any());
    CHECK(fast.wheels[wheel].damage.rim_bend_m > 0.01);
    CHECK(fast.wheels[wheel].damage.rim_bend_m < 0.04);
    CHECK(fast.wheels[wheel].damage.toe_out_rad() > 0.005);
  }
  const VehicleState slow = rolled_over(car, {.height_m = 0.12}, 2.0, 6.0);
  for (const WheelState& wheel : slow.wheels) CHECK_FALSE(wheel.damage.any());
}

TEST_CASE("low edges and walking pace do no damage and the faster the deeper the bend") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const auto& gentle :
       {std::array{0.15, 1.4}, std::array{0.10, 4.0}, std::array{0.05, 14.0}, std::array{0.03, 35.0}}) {
    const VehicleState state = rolled_over(car, {.height_m = gentle[0]}, gentle[1], 8.0 / gentle[1]);
    for (const WheelState& wheel : state.wheels) {
      CHECK_MESSAGE(!wheel.damage.any(), gentle[0], " m at ", gentle[1], " m/s");
    }
  }
  double before_m = 0.0;
  for (const double speed_mps : {10.0, 15.0, 20.0, 25.0}) {
    const double bend_m = rolled_over(car, {.height_m = 0.12}, speed_mps, 15.0 / speed_mps).wheels[0].damage.rim_bend_m;
    CHECK(bend_m > before_m);
    before_m = bend_m;
  }
}

TEST_CASE("a hole does what a kerb does and so does a fall") {
  const VehicleParameters car = read_car("volvo-s80");
  const VehicleState hole = rolled_over(car, {.height_m = -0.12, .to_m = 7.2, .right = false}, 18.0, 1.0);
  CHECK(hole.wheels[0].damage.any());
  CHECK_FALSE(hole.wheels[1].damage.any());
  for (const bool high : {false, true}) {
    VehicleState state = standstill(car, {Vec3(0.0, 0.0, high ? 1.5 : 0.1), Quat(1.0, 0.0, 0.0, 0.0)});
    roll_over(car, road, 2.0, state);
    for (const WheelState& wheel : state.wheels) CHECK(wheel.damage.any() == high);
  }
}

TEST_CASE("what yields under a wheel lifts it and does not damage it") {
  const VehicleParameters car = read_car("volvo-s80");
  for (const bool yields : {true, false}) {
    VehicleState state = standstill(car, {}, 15.0);
    Ground ground = level_ground(0.1);
    for (WheelGround& wheel : ground) wheel.yields = yields;
    drive(car, {}, ground, 0.2, state);
    for (const WheelState& wheel : state.wheels) CHECK(wheel.damage.any() != yields);
  }
}

TEST_CASE("a car with a wheel that was struck pulls to that side and is slowed by it") {
  const VehicleParameters car = read_car("volvo-s80");
  std::array<VehicleOutputs, 3> end;
  for (const int side : {0, 1, 2}) {
    VehicleState state =
        rolled_over(car, {.height_m = 0.12, .to_m = 8.0, .left = side == 0, .right = side == 1}, 20.0, 1.0);
    if (side == 2) state = rolled_over(car, road, 20.0, 1.0);
    roll_over(car, road, 3.0, state);
    end[side] = outputs(car, state);
  }
  CHECK(end[0].world_from_vehicle.position_m.y > 2.0);
  CHECK(end[0].yaw_rate_radps > 0.02);
  CHECK(end[0].yaw_rate_radps < 0.12);
  CHECK(end[1].world_from_vehicle.position_m.y == relative(-end[0].world_from_vehicle.position_m.y, 0.05));
  CHECK(std::abs(end[2].world_from_vehicle.position_m.y) < 0.01);
  // A fifth of the wheel's load of 5 kN on 1.75 t, and the loss by the wheel's slip.
  CHECK(end[2].speed_mps - end[0].speed_mps > 1.5);
  CHECK(end[2].speed_mps - end[0].speed_mps < 5.0);
}

TEST_CASE("a flat tyre lets its corner down onto the rim and answers steering less") {
  const VehicleParameters car = read_car("volvo-s80");
  VehicleState flat = standstill(car, {});
  flat.wheels[0].damage.lost_air = 1.0;
  roll_over(car, road, 3.0, flat);
  CHECK(flat.wheels[0].squeeze_m > sidewall_m(car.tyre));
  CHECK(flat.wheels[0].squeeze_m < sidewall_m(car.tyre) + 0.005);
  CHECK(flat.wheels[0].damage.rim_bend_m == 0.0);  // Standing on a rim does not bend it.
  CHECK(flat.wheels[1].squeeze_m < 0.03);

  TyreContact contact{.load_n = 4000.0, .sliding_mps = {0.0, -0.5}, .rolling_mps = 20.0, .forward_mps = 20.0};
  TyreContact sliding = contact;
  sliding.sliding_mps.y = -100.0;
  const double whole_n = load_sensitive_force(car.tyre, contact).force_n.y,
               whole_sliding_n = load_sensitive_force(car.tyre, sliding).force_n.y;
  contact.firmness = flat.wheels[0].damage.firmness();
  contact.friction *= flat.wheels[0].damage.grip();
  CHECK(load_sensitive_force(car.tyre, contact).force_n.y < 0.35 * whole_n);
  contact.sliding_mps.y = sliding.sliding_mps.y;
  CHECK(load_sensitive_force(car.tyre, contact).force_n.y == doctest::Approx(0.8 * whole_sliding_n));
}

TEST_CASE("air leaves a cut tyre within seconds and damage counts in the state's hash only where there is any") {
  const VehicleParameters car = read_car("volvo-s80");
  WheelDamage damage;
  press_wheel(car.tyre, sidewall_m(car.tyre) - 0.001, 0.001, damage);
  CHECK_FALSE(damage.any());
  press_wheel(car.tyre, sidewall_m(car.tyre) + 0.001, 0.001, damage);
  CHECK(damage.any());
  CHECK(damage.rim_bend_m == 0.0);
  for (int i = 0; i < 2000; ++i) press_wheel(car.tyre, 0.02, 0.001, damage);
  CHECK(damage.lost_air > 0.95);
  CHECK(damage.lost_air <= 1.0);

  VehicleState whole = standstill(car, {}), cut = whole;
  whole.wheels[2].squeeze_m = 0.05;
  CHECK(hash_of(whole) == hash_of(cut));
  cut.wheels[2].damage = damage;
  CHECK(hash_of(whole) != hash_of(cut));
}
