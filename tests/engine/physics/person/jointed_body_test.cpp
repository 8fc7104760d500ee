#include "engine/physics/person/jointed_body.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/math/gravity.hpp"
#include "engine/physics/person/jointed_plans.hpp"
#include "engine/world/vehicle_body.hpp"
#include "tests/engine/physics/person/searle_band.hpp"
#include "tests/relative.hpp"

namespace septet::person {
namespace {

constexpr double tick_s = 1.0 / 120.0;

const VehicleModel& model_named(const char* name) { return vehicle_models()[*find_vehicle_model(name)]; }

MovingSolid vehicle_at(const char* name, double speed_mps) {
  const VehicleModel& model = model_named(name);
  MovingSolid vehicle;
  vehicle.pieces = vehicle_pieces(model);
  vehicle.world_from_vehicle.position_m.x = -model.front_m() - 0.6;
  vehicle.velocity_mps.x = speed_mps;
  vehicle.mass_kg = vehicle_body(model.kind).mass_kg;
  return vehicle;
}

/// One who walks across the way of a vehicle: the left side is struck.
JointedBody walker(double mass_kg = 75.0) {
  const RigidTransform place{{0.0, 0.0, 0.0}, orientation_from_angles(-0.5 * 3.141592653589793, 0.0, 0.0)};
  return standing_body(BodyKind::person, mass_kg, place, Vec3(0.0, -1.3, 0.0));
}

struct Throw {
  double head_at_s = -1.0;      ///< After the first touch.
  double head_behind_m = 0.0;   ///< The head's middle then, behind the vehicle's front.
  Part head_on = Part::below;   ///< What it meets.
  double thrown_m = 0.0;        ///< Way of the mass centre in plan, from the first touch to rest.
  double sinks_m = 0.0;         ///< Its height at the touch less at rest.
  double fastest_mps = 0.0;     ///< Of the mass centre in plan.
  double wrapped_m = 0.0;       ///< Greatest way of the mass centre behind the vehicle's front.
  double ahead_mps = 0.0;       ///< Speed of the mass centre over that of the vehicle, 0.15 s after the touch.
  double alone_m = 0.0;         ///< Way of the mass centre in plan after the vehicle's last touch,
  double lawful_alone_m = 0.0;  ///< and by the law of searle_band.hpp from its motion and height then.
  double uprightness = 1.0;
  bool rests = false;
};

/// A vehicle that brakes from the touch on hits a body in the middle of its front. Assumed: a tenth of a second until the
/// air brakes of heavy vehicles bite.
Throw thrown(const char* name, double speed_mps, JointedBody body = walker()) {
  constexpr double braking_mps2 = 7.0, most_s = 25.0;
  const double brakes_after_s =
      model_named(name).kind == ParticipantKind::lorry || model_named(name).kind == ParticipantKind::bus ? 0.1 : 0.0;
  MovingSolid vehicle = vehicle_at(name, speed_mps);
  const double front_m = model_named(name).front_m();
  Throw result;
  Vec3 from(0.0), left_at(0.0), left_mps(0.0);
  double touched_s = -1.0;
  for (double time_s = 0.0; time_s < most_s; time_s += tick_s) {
    const bool touched = touched_s >= 0.0;
    if (touched && time_s - touched_s > brakes_after_s)
      vehicle.velocity_mps.x = std::max(0.0, vehicle.velocity_mps.x - braking_mps2 * tick_s);
    vehicle.velocity_mps.y = vehicle.velocity_mps.z = 0.0;  // Its tyres hold it.
    vehicle.world_from_vehicle.position_m.x += vehicle.velocity_mps.x * tick_s;
    // Nobody falls before he is touched.
    advance_body(touched ? std::optional<Ground>(Ground{}) : std::nullopt, touched ? gravity_mps2 : 0.0, tick_s,
                 {&vehicle, 1}, body);
    const Touches& touches = vehicle.touches;
    if (touches.body && !touched) touched_s = time_s, from = mass_centre_m(body);
    if (touched_s < 0.0) continue;
    const double front_x = vehicle.world_from_vehicle.position_m.x + front_m;
    if (touches.head && result.head_at_s < 0.0) {
      result.head_at_s = time_s - touched_s;
      result.head_behind_m = front_x - body.masses[0].position_m.x;
      result.head_on = *touches.head;
    }
    const Vec2 motion_mps = Vec2(momentum_ns(body)) / body.mass_kg;
    result.fastest_mps = std::max(result.fastest_mps, glm::length(motion_mps));
    result.wrapped_m = std::max(result.wrapped_m, front_x - mass_centre_m(body).x);
    if (time_s - touched_s < 0.15) result.ahead_mps = motion_mps.x - vehicle.velocity_mps.x;
    if (touches.body) left_at = mass_centre_m(body), left_mps = momentum_ns(body) / body.mass_kg;
    result.thrown_m = glm::length(Vec2(mass_centre_m(body) - from));
    result.sinks_m = from.z - mass_centre_m(body).z;
    if (touched && lies_still(body)) {
      result.rests = true;
      break;
    }
  }
  result.alone_m = glm::length(Vec2(mass_centre_m(body) - left_at));
  result.lawful_alone_m = searle::way_alone_m(left_mps, left_at.z - mass_centre_m(body).z);
  result.uprightness = uprightness(body);
  return result;
}

constexpr std::array speeds_mps{5.0, 7.0, 9.0, 40.0 / 3.6, 13.0, 15.0, 17.0, 20.0, 22.5, 25.0};

}  // namespace

TEST_CASE("a person's masses are those of a body: the whole, and a mass centre at 0.55 to 0.58 of the height") {
  for (const BodyKind kind : {BodyKind::person, BodyKind::bicycle, BodyKind::motorcycle}) {
    double whole = 0.0;
    for (const double share : plan_of(kind).mass_share) whole += share;
    CHECK(whole == relative(1.0, 1e-9));
    REQUIRE(plan_of(kind).mass_share.size() == plan_of(kind).stands_at_m.size());
    REQUIRE(plan_of(kind).mass_share.size() <= most_masses);
    for (const Rod& rod : plan_of(kind).rods) CHECK(rod.least_m > 0.1);
  }
  CHECK(mass_centre_m(walker()).z / 1.75 > 0.55);
  CHECK(mass_centre_m(walker()).z / 1.75 < 0.58);
}

TEST_CASE("throws by cars, vans, lorries and buses lie in Searle's band at ten speeds") {
  for (const char* name : {"volvo-s80", "hatchback", "suv", "van", "ambulance", "lorry", "city-bus"})
    for (const double speed_mps : speeds_mps) {
      const Throw found = thrown(name, speed_mps);
      const searle::Band band = searle::band(found.thrown_m, found.sinks_m);
      MESSAGE(std::string(name) << " " << speed_mps << " m/s: " << found.thrown_m << " m, " << band.least_mps << " to "
                                << band.most_mps << " m/s");
      CAPTURE(name);
      CHECK(found.rests);
      CHECK(speed_mps > band.least_mps);
      CHECK(speed_mps < band.most_mps);
    }
}

TEST_CASE("whom the vehicle no longer touches comes as far as his speed, his height and friction give") {
  // Slower bodies end by rolling over, a few decimetres more or less.
  for (const char* name : {"volvo-s80", "hatchback", "van", "lorry"})
    for (const double speed_mps : {13.0, 15.0, 17.0, 20.0, 22.5, 25.0}) {
      const Throw found = thrown(name, speed_mps);
      CAPTURE(name);
      CAPTURE(speed_mps);
      CHECK(found.alone_m == relative(found.lawful_alone_m, 0.04));
    }
}

TEST_CASE("a flat front does not press down whom it has met, and lifts off him who lies under it") {
  const std::vector<Piece> lorry = vehicle_pieces(model_named("lorry"));
  REQUIRE(lorry.size() == 1);
  const double front_m = model_named("lorry").front_m(), low_m = vehicle_body(ParticipantKind::lorry).clearance_m;
  constexpr double radius_m = 0.065;
  // A knee just over its lower edge, deeper behind the front than over the edge.
  CHECK(depth_in(lorry[0], {front_m - 0.2, 0.0, low_m + 0.04}, radius_m).part == Part::bumper);
  CHECK(depth_in(lorry[0], {front_m - 0.2, 0.0, low_m - 0.04}, radius_m).part == Part::below);
  CHECK(depth_in(lorry[0], {front_m - 2.0, 0.0, low_m + 0.04}, radius_m).part == Part::below);
  CHECK(depth_in(lorry[0], {front_m - 0.02, 0.0, low_m - 0.04}, radius_m).depth_m < 0.03);
}

TEST_CASE("a car's bonnet is wrapped, and from 40 km/h on the head meets a short one's windscreen after 60 to 150 ms") {
  for (const double speed_kmh : {40.0, 45.0, 50.0, 55.0, 60.0}) {
    const Throw found = thrown("hatchback", speed_kmh / 3.6);
    MESSAGE(speed_kmh << " km/h: head " << found.head_at_s << " s, " << found.head_behind_m << " m behind the front");
    CHECK(found.head_on == Part::windscreen);
    CHECK(found.head_at_s > 0.06);
    CHECK(found.head_at_s < 0.15);
    CHECK(found.wrapped_m > 0.4);
  }
  // Slower, or on a longer bonnet, it comes down before the windscreen.
  for (const double speed_kmh : {20.0, 30.0}) CHECK(thrown("hatchback", speed_kmh / 3.6).head_on == Part::bonnet);
  const Throw town = thrown("volvo-s80", 40.0 / 3.6), fast = thrown("volvo-s80", 22.5);
  MESSAGE("volvo-s80: head " << town.head_at_s << " s, " << town.head_behind_m << " m; at 22.5 m/s " << fast.head_at_s
                             << " s, " << fast.head_behind_m << " m");
  CHECK(town.head_on == Part::bonnet);
  CHECK(town.head_behind_m > 1.1);
  CHECK(town.head_at_s < 0.15);
  CHECK(fast.head_on == Part::windscreen);
  CHECK(fast.head_at_s > 0.06);
}

TEST_CASE("a high front throws forward: nobody comes onto it") {
  for (const char* name : {"lorry", "city-bus"}) {
    for (const double speed_mps : {9.0, 40.0 / 3.6, 15.0}) {
      const Throw found = thrown(name, speed_mps);
      CAPTURE(name);
      CHECK(found.head_at_s < 0.05);
      CHECK(found.ahead_mps > -1.0);
      CHECK(found.uprightness < 0.4);
      CHECK(found.fastest_mps > 0.9 * speed_mps);
    }
  }
  const Throw van = thrown("van", 40.0 / 3.6), car = thrown("volvo-s80", 40.0 / 3.6);
  CHECK(van.head_at_s < car.head_at_s);
  CHECK(van.wrapped_m < car.wrapped_m);
}

TEST_CASE("nobody stands after more than 3 m/s, whatever side is hit and by what") {
  for (const char* name : {"volvo-s80", "van", "lorry"})
    for (const double speed_mps : {3.1, 4.0, 6.0, 12.0})
      for (const double heading_rad : {0.0, 0.8, 1.6, 2.4, 3.1, -0.8, -1.6, -2.4}) {
        const RigidTransform place{{0.0, 0.1, 0.0}, orientation_from_angles(heading_rad, 0.0, 0.0)};
        const Throw found = thrown(name, speed_mps, standing_body(BodyKind::person, 75.0, place, Vec3(0.0)));
        CAPTURE(name);
        CAPTURE(speed_mps);
        CAPTURE(heading_rad);
        CHECK(found.uprightness < 0.4);
        CHECK(found.sinks_m > 0.65);  // To 0.3 m above the road at most, be it on his head.
        CHECK(found.rests);
      }
}

TEST_CASE("the vehicle loses what bodies get, to the rounding of the sums") {
  for (const BodyKind kind : {BodyKind::person, BodyKind::bicycle, BodyKind::motorcycle}) {
    MovingSolid car = vehicle_at("hatchback", 12.0);
    JointedBody body =
        standing_body(kind, 80.0, {{0.0, 0.2, 0.0}, orientation_from_angles(1.0, 0.0, 0.0)}, Vec3(0.5, -1.0, 0.0));
    const auto whole = [&] { return momentum_ns(body) + car.mass_kg * car.velocity_mps; };
    const Vec3 before = whole();
    const Vec3 car_before = car.velocity_mps;
    for (int tick = 0; tick < 60; ++tick) {
      car.world_from_vehicle.position_m += tick_s * car.velocity_mps;
      advance_body({}, 0.0, tick_s, {&car, 1}, body);
    }
    CHECK(glm::length(car.taken_ns) > 300.0);
    CHECK(glm::length(whole() - before) < 1e-9 * glm::length(before));
    CHECK(glm::length(car.mass_kg * (car.velocity_mps - car_before) - car.taken_ns) < 1e-6);
  }
}

TEST_CASE("a body in the air keeps its momentum, its angular momentum and its rods") {
  JointedBody body = walker();
  const Plan& plan = plan_of(body.kind);
  for (std::size_t i = 0; i < plan.mass_share.size(); ++i)
    body.masses[i].velocity_mps += glm::cross(Vec3(1.5, 0.7, -0.5), body.masses[i].position_m);
  const auto spin = [&] {
    Vec3 sum(0.0);
    for (std::size_t i = 0; i < plan.mass_share.size(); ++i)
      sum += plan.mass_share[i] * body.mass_kg *
             glm::cross(body.masses[i].position_m - mass_centre_m(body), body.masses[i].velocity_mps);
    return sum;
  };
  const Vec3 momentum = momentum_ns(body), angular = spin();
  for (int tick = 0; tick < 120; ++tick) advance_body({}, 0.0, tick_s, {}, body);
  CHECK(glm::length(momentum_ns(body) - momentum) < 1e-9 * glm::length(momentum));
  // Rods are straightened in their places, along themselves, which turns by what the velocities differ across them.
  CHECK(glm::length(spin() - angular) < 0.03 * glm::length(angular));
  for (const Rod& rod : plan.rods)
    CHECK(glm::length(body.masses[rod.b].position_m - body.masses[rod.a].position_m) == relative(rod.least_m, 0.01));
}

TEST_CASE("who stands is drawn where he stands, and a leg that is swung is drawn swung") {
  const RigidTransform place{{3.0, -2.0, 0.5}, orientation_from_angles(0.7, 0.0, 0.0)};
  JointedBody body = standing_body(BodyKind::person, 75.0, place, Vec3(2.0, 1.0, 0.0));
  DrawnPose pose = drawn_pose(body);
  CHECK(glm::length(pose.world_from_body.position_m - place.position_m) < 1e-9);
  CHECK(std::abs(glm::dot(pose.world_from_body.orientation, place.orientation)) == doctest::Approx(1.0));
  CHECK(glm::length(pose.velocity_mps - Vec3(2.0, 1.0, 0.0)) < 1e-6);
  for (const double joint : pose.joints_rad) CHECK(std::abs(joint) < 1e-6);
  // The left foot straight ahead of its hip.
  const Vec3 hip = body.masses[3].position_m;
  body.masses[5].position_m = hip + place.orientation * Vec3(thigh_m, 0.0, 0.0);
  body.masses[7].position_m = hip + place.orientation * Vec3(thigh_m + shin_m, 0.0, 0.0);
  pose = drawn_pose(body);
  CHECK(pose.joints_rad[0] == relative(1.5708, 0.01));
  CHECK(std::abs(pose.joints_rad[2]) < 1e-6);
  for (const BodyKind kind : {BodyKind::bicycle, BodyKind::motorcycle}) {
    const DrawnPose machine = drawn_pose(standing_body(kind, 20.0, place, Vec3(0.0)));
    CHECK(glm::length(machine.world_from_body.position_m - place.position_m) < 1e-9);
    CHECK(std::abs(glm::dot(machine.world_from_body.orientation, place.orientation)) == doctest::Approx(1.0));
  }
}

TEST_CASE("a machine without its rider falls over and slides to rest at the deceleration of its friction") {
  for (const BodyKind kind : {BodyKind::bicycle, BodyKind::motorcycle}) {
    constexpr double speed_mps = 12.0;
    // Across its wheels' way: it slides and does not roll.
    JointedBody body =
        standing_body(kind, 20.0, {{0.0, 0.0, 0.0}, orientation_from_angles(1.4, 0.0, 0.0)}, Vec3(speed_mps, 0.0, 0.0));
    int tick = 0;
    for (; tick < 1800 && !lies_still(body); ++tick) advance_body(Ground{}, gravity_mps2, tick_s, {}, body);
    CHECK(lies_still(body));
    const double friction = plan_of(kind).ground_friction;
    const double slide_m = speed_mps * speed_mps / (2.0 * friction * gravity_mps2);
    CHECK(mass_centre_m(body).x == relative(slide_m, 0.25));
    CHECK(std::abs((drawn_pose(body).world_from_body.orientation * Vec3(0.0, 0.0, 1.0)).z) < 0.5);
  }
}

TEST_CASE("equal bodies move equally to the bit, and one that lies is not moved") {
  JointedBody one = walker(), other = walker();
  MovingSolid first = vehicle_at("hatchback", 14.0), second = first;
  for (int tick = 0; tick < 600; ++tick) {
    for (MovingSolid* vehicle : {&first, &second})
      vehicle->world_from_vehicle.position_m += tick_s * vehicle->velocity_mps;
    advance_body(Ground{}, gravity_mps2, tick_s, {&first, 1}, one);
    advance_body(Ground{}, gravity_mps2, tick_s, {&second, 1}, other);
  }
  for (std::size_t i = 0; i < most_masses; ++i) {
    CHECK(one.masses[i].position_m == other.masses[i].position_m);
    CHECK(one.masses[i].velocity_mps == other.masses[i].velocity_mps);
  }
}

}  // namespace septet::person
