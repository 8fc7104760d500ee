// Wheel locations, steering, and the driver's feedback.

#include "engine/physics/vehicle/suspension.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/physics/vehicle/controls.hpp"
#include "tests/engine/physics/vehicle/car.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::vehicle;

TEST_CASE("a wheel's path has the slopes that the tables give") {
  const VehicleParameters car = read_car("volvo-s80");
  const Statics known = statics(car);
  constexpr double h = 1e-5;
  for (int wheel = 0; wheel < wheel_count; ++wheel)
    for (const double travel : {-0.06, -0.01, 0.03, 0.07}) {
      const auto at = [&](double travel_m) {
        WheelState state;
        state.travel_m = travel_m;
        return place_wheel(car, known, wheel, state, 0.0);
      };
      const WheelPlace here = at(travel), up = at(travel + h), down = at(travel - h);
      const Vec3 centre = (up.centre_m - down.centre_m) / (2.0 * h);
      const double contact_left = (up.contact_left_m - down.contact_left_m) / (2.0 * h);
      CHECK(std::abs(contact_left - here.contact_slope.y) < 1e-6);
      CHECK(glm::length(Vec2(centre) - here.centre_slope) < 1e-6);
      CHECK(centre.z == doctest::Approx(1.0));
    }
}

TEST_CASE("each axle carries its share and stands as high as its tyres give") {
  const VehicleParameters car = read_car("volvo-s80");
  const Statics known = statics(car);
  const double weight_n = car.body.mass_kg * gravity_mps2;
  const double front_n = 2.0 * (known.sprung_load_n[0] + car.suspension[0].unsprung_mass_kg * gravity_mps2);
  const double rear_n = 2.0 * (known.sprung_load_n[1] + car.suspension[1].unsprung_mass_kg * gravity_mps2);
  CHECK(front_n + rear_n == doctest::Approx(weight_n));
  CHECK(known.sprung_load_n[0] / known.sprung_load_n[1] ==
        doctest::Approx(car.body.mass_centre_x_m / (car.body.wheelbase_m - car.body.mass_centre_x_m)));
  CHECK(car.tyre.radius_m - known.centre_z_m[0] == relative(0.5 * front_n / car.tyre.vertical_stiffness_npm, 1e-6));
}

TEST_CASE("a spring holds its own wheel and an anti-roll bar resists the difference of both") {
  const VehicleParameters car = read_car("volvo-s80");
  const Statics known = statics(car);
  const auto force_n = [&](double left_m, double right_m, double left_rate_mps = 0.0) {
    std::array<WheelState, wheel_count> wheels;
    wheels[0].travel_m = left_m;
    wheels[1].travel_m = right_m;
    wheels[0].travel_rate_mps = left_rate_mps;
    return suspension_force_n(car, known, 0, wheels);
  };
  const SuspensionParameters& front = car.suspension[0];
  CHECK(force_n(0.0, 0.0) == doctest::Approx(known.sprung_load_n[0]));
  CHECK(force_n(0.03, 0.03) - force_n(0.0, 0.0) == doctest::Approx(front.spring_force_n(0.03)));
  CHECK(force_n(0.03, -0.03) - force_n(0.03, 0.03) == doctest::Approx(front.anti_roll_npm * 0.06));
  CHECK(force_n(0.0, 0.02) - force_n(0.0, 0.0) == doctest::Approx(-front.anti_roll_npm * 0.02));
  CHECK(force_n(0.0, 0.0, 0.3) - force_n(0.0, 0.0) == doctest::Approx(front.damper_force_n(0.3)));
}

TEST_CASE("the inner front wheel turns further by the share of the Ackermann condition") {
  VehicleParameters car = read_car("volvo-s80");
  const WheelState still;
  const double toe_rad = -car.suspension[0].toe_rad(0.0);
  for (const double mean_rad : {0.1, -0.1}) {
    const double left = wheel_steer_rad(car, 0, still, mean_rad) - toe_rad,
                 right = wheel_steer_rad(car, 1, still, mean_rad) + toe_rad;
    CHECK(0.5 * (left + right) == doctest::Approx(mean_rad));
    // cot of the outer less cot of the inner angle is the track over the wheelbase.
    const double geometric = car.suspension[0].track_m / car.body.wheelbase_m * mean_rad * mean_rad;
    CHECK(left - right == relative(car.steering.ackermann * geometric, 0.02));
  }
  // Rear wheels have their toe alone: in on both sides.
  CHECK(wheel_steer_rad(car, 2, still, 0.1) == doctest::Approx(-car.suspension[1].toe_rad(0.0)));
  CHECK(wheel_steer_rad(car, 3, still, 0.1) == doctest::Approx(car.suspension[1].toe_rad(0.0)));
}

TEST_CASE("a side force turns a front wheel out of the bend and an aligning torque as it pulls") {
  const VehicleParameters car = read_car("volvo-s80");
  const SuspensionParameters& front = car.suspension[0];
  WheelState wheel;
  const double free_rad = wheel_steer_rad(car, 0, wheel, 0.0);
  wheel.force_n.y = 2000.0;
  CHECK(wheel_steer_rad(car, 0, wheel, 0.0) - free_rad ==
        doctest::Approx(-2000.0 * front.toe_out_by_lateral_force_radpn));
  wheel.force_n.y = 0.0;
  wheel.aligning_nm = -50.0;
  CHECK(wheel_steer_rad(car, 0, wheel, 0.0) - free_rad ==
        doctest::Approx(-50.0 * front.steer_by_aligning_torque_radpnm));
}

TEST_CASE("bump leans a strut's wheel inwards and a force to the left leans it to the right") {
  const VehicleParameters car = read_car("volvo-s80");
  const Statics known = statics(car);
  WheelState wheel;
  wheel.travel_m = 0.05;
  // The spin axis points to the left; leaning to the right lifts it on the left.
  const double left = place_wheel(car, known, 0, wheel, 0.0).spin_axis.z,
               right = place_wheel(car, known, 1, wheel, 0.0).spin_axis.z;
  CHECK(left == doctest::Approx(-std::sin(car.suspension[0].camber_rad(0.05))));
  CHECK(right == doctest::Approx(-left));
  wheel.force_n.y = 3000.0;
  CHECK(place_wheel(car, known, 0, wheel, 0.0).spin_axis.z - left ==
        relative(3000.0 * car.suspension[0].camber_by_lateral_force_radpn, 0.01));
}

namespace {

/// Torque of the hand wheel after it has been held straight for a second with these forces on the front wheels.
double hand_torque_nm(const VehicleParameters& car, const Vec3& left_n, const Vec3& right_n, double aligning_nm,
                      double speed_mps) {
  VehicleState state;
  state.wheels[0].force_n = left_n;
  state.wheels[1].force_n = right_n;
  state.wheels[0].aligning_nm = state.wheels[1].aligning_nm = aligning_nm;
  for (int i = 0; i < 1000; ++i) advance_steering(car, 0.0, speed_mps, 0.001, state);
  return state.steering.torque_nm;
}

}  // namespace

TEST_CASE(
    "caster and trail pull the hand wheel against the side force and a wheel braked alone pulls by its scrub radius") {
  VehicleParameters car = read_car("volvo-s80");
  car.steering.scrub_radius_m = 0.02;  // Positive: the contact lies outside of the kingpin.
  const double speed_mps = 20.0;
  const Vec3 none(0.0), to_left(0.0, 2000.0, 0.0), braked(-3000.0, 0.0, 0.0);
  CHECK(hand_torque_nm(car, none, none, 0.0, speed_mps) == 0.0);
  CHECK(hand_torque_nm(car, to_left, to_left, 0.0, speed_mps) < -0.1);
  CHECK(hand_torque_nm(car, none, none, -40.0, speed_mps) < -0.1);
  CHECK(hand_torque_nm(car, braked, none, 0.0, speed_mps) > 0.1);
  CHECK(hand_torque_nm(car, none, braked, 0.0, speed_mps) < -0.1);
  CHECK(std::abs(hand_torque_nm(car, braked, braked, 0.0, speed_mps)) < 1e-9);
}

TEST_CASE("turning on the spot takes more torque than turning at speed") {
  const VehicleParameters car = read_car("volvo-s80");
  const auto turning_nm = [&](double speed_mps) {
    VehicleState state = standstill(car, {});
    for (int i = 0; i < 200; ++i) advance_steering(car, 0.002 * i, speed_mps, 0.001, state);
    return -state.steering.torque_nm;
  };
  const double unassisted = 1.0 - car.steering.assistance(0.0);
  const double load_n = 0.59 * car.body.mass_kg * gravity_mps2;
  // Two standing tyres of this load rub over a lever of 4 cm, at a rate where 0.87 of friction acts.
  CHECK(turning_nm(0.0) - turning_nm(30.0) > 0.5 * unassisted * 0.04 * load_n / car.steering.ratio);
}
