#include "engine/driver/driver_view.hpp"

#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"
#include "tests/shipped_files.hpp"

namespace septet::driver {
namespace {

using road::motorway;

/// The driver's car in the right-hand lane, and a saloon 40 m ahead, so far to the left of that lane's middle.
struct Ahead {
  Snapshot snapshot;

  explicit Ahead(double left_m, double sideways_mps = 0.0) {
    snapshot.driver_car.participant = 1;
    snapshot.driver_car.speed_mps = 25.0;
    for (const ParticipantId id : {1u, 2u}) {
      Participant body;
      body.id = id;
      body.model = *find_vehicle_model(id == 1 ? "volvo-s80" : "saloon");
      const road::LanePosition place{0, -7, id == 1 ? 3000.0 : 3040.0, id == 1 ? 0.0 : left_m};
      body.world_from_vehicle = road::world_from_lane(road::evaluate_lane(motorway(), place));
      body.velocity_mps = body.world_from_vehicle.orientation * Vec3(20.0, id == 1 ? 0.0 : sideways_mps, 0.0);
      snapshot.participants.push_back(body);
    }
  }
  std::vector<SeenVehicle> seen() const {
    const auto corridor = find_corridor(motorway(), snapshot);
    REQUIRE(corridor);
    const auto own = see_own_place(motorway(), *corridor, snapshot, std::nullopt);
    REQUIRE(own);
    return see_vehicles(motorway(), *corridor, snapshot.participants, 1, *own);
  }
};

}  // namespace

TEST_CASE("a vehicle on the hard shoulder is in nobody's way, one with a wheel in the lane is") {
  CHECK(Ahead(-3.1).seen().empty());
  const auto over_the_line = Ahead(-2.3).seen();
  REQUIRE(over_the_line.size() == 1);
  CHECK(over_the_line[0].innermost_lane == 7);
  CHECK(over_the_line[0].outermost_lane == 7);
  CHECK(over_the_line[0].is_ahead);
  CHECK(over_the_line[0].gap_m == relative(35.2, 0.02));
}

TEST_CASE("a vehicle is in the lanes that its body lies over, and a second early in the one it comes to") {
  const auto in_lane = Ahead(3.75).seen(), on_line = Ahead(1.9).seen(), coming = Ahead(3.2, -1.0).seen();
  REQUIRE(in_lane.size() + on_line.size() + coming.size() == 3);
  CHECK(in_lane[0].innermost_lane == 6);
  CHECK(in_lane[0].outermost_lane == 6);
  CHECK(on_line[0].innermost_lane == 6);
  CHECK(on_line[0].outermost_lane == 7);
  CHECK(coming[0].outermost_lane == 7);
}

namespace {

/// Somebody so far to the left of the middle of the driver's lane, 40 m ahead, who moves straight to the left (or right).
std::vector<SeenVehicle> seen_across(const char* model, double left_m, double to_left_mps, bool siren = false) {
  Ahead scene(left_m);
  Participant& other = scene.snapshot.participants[1];
  other.model = *find_vehicle_model(model);
  other.velocity_mps = other.world_from_vehicle.orientation * Vec3(0.0, to_left_mps, 0.0);
  const Quat turned = orientation_from_angles(to_left_mps > 0.0 ? 1.5708 : -1.5708, 0.0, 0.0);
  other.world_from_vehicle.orientation = other.world_from_vehicle.orientation * turned;
  other.lamps.set(Lamp::siren, siren);
  return scene.seen();
}

}  // namespace

TEST_CASE(
    "one on foot beside the lanes is in the way if his walk leads into them before the car is there, and goes nowhere "
    "along") {
  const auto walks_in = seen_across("pedestrian", -3.6, 1.8);
  REQUIRE(walks_in.size() == 1);
  CHECK(walks_in[0].outermost_lane == 7);
  CHECK(std::abs(walks_in[0].speed_mps) < 0.1);
  CHECK(seen_across("pedestrian", -3.6, 0.0).empty());
  CHECK(seen_across("pedestrian", -3.6, -1.8).empty());
  CHECK(seen_across("pedestrian", -9.0, 1.8).empty());
}

TEST_CASE("a vehicle that comes across counts once it cannot stop before the lanes, one with a siren before that") {
  CHECK(seen_across("saloon", -13.0, 6.0).empty());
  CHECK(seen_across("saloon", -13.0, 6.0, true).size() == 1);
  CHECK(seen_across("saloon", -14.0, 14.0).size() == 1);
}

TEST_CASE("braking is seen by the speed that it takes, within a second, and not in one who was not there before") {
  std::vector<SeenVehicle> before, now;
  for (int look = 0; look < 40; ++look) {
    now = {{.id = 5, .speed_mps = 30.0 - 4.0 * 0.05 * look}};
    see_accelerations(before, 0.05, now);
    if (look == 0) CHECK(now[0].acceleration_mps2 == 0.0);
    if (look == 20) CHECK(now[0].acceleration_mps2 < -3.0);
    before = now;
  }
  CHECK(now[0].acceleration_mps2 == relative(-4.0, 0.05));
}

TEST_CASE("the driver knows how far the sides of the car are from the lines of its lane") {
  Ahead scene(0.0);
  const road::LanePosition left_of_middle{0, -7, 3000.0, 0.5};
  scene.snapshot.participants[0].world_from_vehicle =
      road::world_from_lane(road::evaluate_lane(motorway(), left_of_middle));
  const auto corridor = find_corridor(motorway(), scene.snapshot);
  REQUIRE(corridor);
  const auto own = see_own_place(motorway(), *corridor, scene.snapshot, std::nullopt);
  REQUIRE(own);
  const double width_m = vehicle_models()[scene.snapshot.participants[0].model].width_m;
  CHECK(own->room_right_m - own->room_left_m == relative(1.0, 0.01));
  CHECK(own->room_right_m + own->room_left_m ==
        doctest::Approx(road::lane_width_m(motorway(), 0, -7, 3000.0) - width_m));
}

TEST_CASE("what was seen a while ago is taken to have gone on evenly") {
  const std::vector<SeenVehicle> seen{{.id = 2, .is_ahead = true, .gap_m = 30.0, .speed_mps = 20.0},
                                      {.id = 3, .is_ahead = false, .gap_m = 30.0, .speed_mps = 20.0}};
  const auto now = remembered_vehicles(seen, 0.5, 26.0);
  CHECK(now[0].gap_m == doctest::Approx(27.0));
  CHECK(now[1].gap_m == doctest::Approx(33.0));
}

}  // namespace septet::driver
