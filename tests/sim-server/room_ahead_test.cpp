#include "sim-server/sumo/room_ahead.hpp"

#include <cmath>
#include <vector>

#include <doctest/doctest.h>

namespace septet::server {
namespace {

RigidTransform at(double x, double y, double heading_rad = 0.0) {
  return {Vec3(x, y, 0.0), orientation_from_angles(heading_rad, 0.0, 0.0)};
}

}  // namespace

TEST_CASE("room ahead is measured to the nearest body in the strip, turned as the vehicle is, and never to itself") {
  const VehicleModel& car = vehicle_models()[0];
  const auto room_m = [&](const RigidTransform& own, const std::vector<RigidTransform>& others) {
    std::vector<PlanOutline> bodies{plan_outline(own, car)};
    for (const RigidTransform& other : others) bodies.push_back(plan_outline(other, car));
    return room_ahead_m(own, car, 0.2, bodies);
  };
  const double length = car.front_m() + car.rear_overhang_m, width = car.width_m;
  CHECK(std::isinf(room_m(at(0, 0), {})));
  CHECK(room_m(at(0, 0), {at(length + 3.0, 0), at(length + 2.0, 0)}) == doctest::Approx(2.0));
  CHECK(std::isinf(room_m(at(0, 0), {at(-length - 1.0, 0)})));
  CHECK(room_m(at(0, 0), {at(length + 2.0, width + 0.1)}) == doctest::Approx(2.0));
  CHECK(std::isinf(room_m(at(0, 0), {at(length + 2.0, width + 0.3)})));
  // The same pair, both turned about the origin.
  const double turn = 0.7;
  CHECK(room_m(at(0, 0, turn), {at((length + 2.0) * std::cos(turn), (length + 2.0) * std::sin(turn), turn)}) ==
        doctest::Approx(2.0));
  // One that lies across: its side is ahead, though no corner of it is.
  const double middle = 0.5 * (car.front_m() - car.rear_overhang_m);
  CHECK(room_m(at(0, 0), {at(car.front_m() + 2.0 + 0.5 * width, -middle, 0.5 * 3.141592653589793)}) ==
        doctest::Approx(2.0));
}

}  // namespace septet::server
