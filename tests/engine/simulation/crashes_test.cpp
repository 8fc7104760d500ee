// Colliding boxes, and what breaks off them.

#include "engine/simulation/effects/crashes.hpp"

#include <cmath>

#include <doctest/doctest.h>
#include <glm/geometric.hpp>

#include "engine/effects/debris/contacts.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/world/vehicle_body.hpp"
#include "tests/engine/simulation/placed_participant.hpp"
#include "tests/relative.hpp"

using namespace septet;
using namespace septet::simulation;

namespace {

double front_m(const Participant& p) { return vehicle_models()[p.model].front_m(); }
double rear_m(const Participant& p) { return vehicle_models()[p.model].rear_overhang_m; }

/// The driver's car behind another one, their bumpers ten centimetres in each other.
std::vector<Participant> in_a_row(std::string_view ahead, double speed_mps, double ahead_mps) {
  std::vector<Participant> both{placed_participant(1, "volvo-s80", 0.0, 0.0, 0.0, speed_mps),
                                placed_participant(7, ahead, 0.0, 0.0, 0.0, ahead_mps)};
  both[1].world_from_vehicle.position_m.x = front_m(both[0]) + rear_m(both[1]) - 0.1;
  return both;
}

CrashOutcome crash(const std::vector<Participant>& participants) {
  CrashMemory memory;
  memory.struck_vehicles = {struck(participants[0], participants[1])};
  debris::State debris;
  Random random(1);
  const CrashOutcome outcome = advance_crashes(participants, 1, {}, memory, debris, random);
  CHECK(memory.struck_vehicles.empty());
  return outcome;
}

}  // namespace

TEST_CASE("cars that part or touch at walking pace have no crash") {
  CHECK(crash(in_a_row("saloon", 10.0, 12.0)).crashes == 0);
  CHECK(crash(in_a_row("saloon", 10.0, 7.2)).crashes == 0);
  CHECK(crash(in_a_row("saloon", 10.0, 6.8)).crashes == 1);
}

TEST_CASE("two boxes touch where their sides do and the shortest way out is the normal") {
  Participant one = placed_participant(1, "saloon", 0.0, 0.0, 0.5, 0.0);
  const debris::Box a = body_box(one);
  const Vec3 left = a.world_from_box.orientation * Vec3(0.0, 1.0, 0.0),
             ahead = a.world_from_box.orientation * Vec3(1.0, 0.0, 0.0);
  const auto moved = [&](const Vec3& by) {
    debris::Box b = a;
    b.world_from_box.position_m += by;
    return b;
  };
  const double width = 2.0 * a.half_size_m.y, length = 2.0 * a.half_size_m.x;
  const auto side = contact_of(a, moved((width - 0.1) * left + 1.0 * ahead));
  REQUIRE(side);
  CHECK(side->depth_m == doctest::Approx(0.1));
  CHECK(glm::length(side->normal + left) < 1e-9);  // From b, which is to the left, to a.
  const auto front = contact_of(a, moved((length - 0.2) * ahead));
  REQUIRE(front);
  CHECK(front->depth_m == doctest::Approx(0.2));
  CHECK(glm::length(front->normal + ahead) < 1e-9);
  CHECK(glm::length(front->point_m - (a.world_from_box.position_m + 0.5 * (length - 0.2) * ahead)) < 0.15);
  CHECK_FALSE(contact_of(a, moved((width + 0.01) * left)));
  CHECK_FALSE(contact_of(a, moved((length + 0.01) * ahead)));
  CHECK(contact_of(a, moved(Vec3(0.0, 0.0, 1.9 * a.half_size_m.z))));
  CHECK_FALSE(contact_of(a, moved(Vec3(0.0, 0.0, 2.1 * a.half_size_m.z))));
}

TEST_CASE("a corner that a turned box keeps free is no contact") {
  const debris::Box a = body_box(placed_participant(1, "saloon", 0.0, 0.0, 0.0, 0.0));
  // Turned by 45 degrees beside the front corner: the axes of a alone would have them overlap.
  debris::Box b = a;
  b.world_from_box.orientation = orientation_from_angles(0.785398, 0.0, 0.0);
  const double reach = (b.half_size_m.x + b.half_size_m.y) * std::sqrt(0.5);
  b.world_from_box.position_m += Vec3(a.half_size_m.x + reach - 0.3, -(a.half_size_m.y + reach - 0.3), 0.0);
  CHECK_FALSE(contact_of(a, b));
  CHECK_FALSE(contact_of(b, a));
}

TEST_CASE("a body begins above the ground and its middle moves with the turn of the vehicle") {
  Participant car = placed_participant(1, "saloon", 3.0, 4.0, 1.0, 10.0);
  car.angular_velocity_radps = {0.0, 0.0, 0.5};
  const VehicleModel& model = vehicle_models()[car.model];
  const debris::Box box = body_box(car);
  CHECK(2.0 * box.half_size_m.x == doctest::Approx(model.length_m));
  CHECK(2.0 * box.half_size_m.y == doctest::Approx(model.width_m));
  CHECK(box.world_from_box.position_m.z - box.half_size_m.z == doctest::Approx(0.2));
  CHECK(box.world_from_box.position_m.z + box.half_size_m.z == doctest::Approx(model.height_m));
  const Vec3 forward = box.world_from_box.orientation * Vec3(1.0, 0.0, 0.0),
             left = box.world_from_box.orientation * Vec3(0.0, 1.0, 0.0);
  CHECK(glm::dot(box.world_from_box.position_m - car.world_from_vehicle.position_m, forward) ==
        doctest::Approx(model.centre_x_m()));
  CHECK(glm::dot(box.velocity_mps, forward) == doctest::Approx(10.0));
  CHECK(glm::dot(box.velocity_mps, left) == doctest::Approx(0.5 * model.centre_x_m()));
}

TEST_CASE("a car's front is cut off from the edge of its bonnet to where its roof begins") {
  const Participant car = placed_participant(1, "saloon", 0.0, 0.0, 0.0, 0.0);
  const VehicleModel& model = vehicle_models()[car.model];
  const FrontSlope slope = front_slope(model.kind).value();
  const debris::Box box = body_box(car);
  const double edge_m = slope.edge_height * model.height_m,
               roof_m = model.front_m() - slope.roof_begins * model.length_m;
  CHECK(debris::gap_to_box(box, {model.front_m() - 0.01, 0.0, edge_m - 0.03}).gap_m < 0.0);
  CHECK(debris::gap_to_box(box, {model.front_m() - 0.01, 0.0, edge_m + 0.03}).gap_m > 0.0);
  CHECK(debris::gap_to_box(box, {roof_m - 0.03, 0.0, model.height_m - 0.01}).gap_m < 0.0);
  CHECK(debris::gap_to_box(box, {roof_m + 0.1, 0.0, model.height_m - 0.01}).gap_m > 0.0);
}

TEST_CASE(
    "parts are thrown with the motion that the car had when it touched what stands, though it stands itself now") {
  const std::vector<Participant> stopped{placed_participant(1, "volvo-s80", 0.0, 0.0, 0.0, 0.0)};
  vehicle::HullTouch touch;
  touch.point_m = stopped[0].world_from_vehicle * Vec3(front_m(stopped[0]), 0.5, 0.5);
  touch.normal = {-1.0, 0.0, 0.0};
  touch.velocity_mps = {15.0, 0.0, 0.0};
  touch.closing_speed_mps = 15.0;
  touch.mass_kg = 1545.0;
  CrashMemory memory;
  memory.struck_standing = {{1, touch}};
  debris::State debris;
  Random random(1);
  const CrashOutcome outcome = advance_crashes(stopped, 1, {}, memory, debris, random);
  CHECK(outcome.crashes == 1);
  CHECK(outcome.pieces > 0);
}
