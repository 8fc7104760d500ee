#include <doctest/doctest.h>

#include "engine/road/lane_geometry.hpp"
#include "sim-server/drive/session_log.hpp"
#include "tests/engine/road/road_files.hpp"
#include "tests/relative.hpp"

namespace septet::server {
namespace {

/// The driver's car in the right-hand lane, and a saloon 40 m ahead, so far to the left of that lane's middle.
Snapshot saloon_ahead(double left_m) {
  const road::RoadNetwork& roads = road::motorway();
  Snapshot snapshot;
  for (const ParticipantId id : {1u, 2u}) {
    Participant body;
    body.id = id;
    body.model = *find_vehicle_model(id == 1 ? "volvo-s80" : "saloon");
    const road::LanePosition place{0, -7, id == 1 ? 3000.0 : 3040.0, id == 1 ? 0.0 : left_m};
    body.world_from_vehicle = road::world_from_lane(road::evaluate_lane(roads, place));
    snapshot.participants.push_back(body);
  }
  const VehicleModel& model = vehicle_models()[snapshot.participants[0].model];
  snapshot.driver_car.participant = 1;
  snapshot.driver_car.lane = -7;
  snapshot.driver_car.road_s_m = 3000.0 + model.wheelbase_m;
  snapshot.driver_car.speed_mps = 20.0;
  return snapshot;
}

}  // namespace

TEST_CASE("the log's leader is whose body is in the driver's lane, not who stands on the shoulder beside it") {
  CHECK_FALSE(find_leader(saloon_ahead(-3.1), road::motorway()));
  CHECK_FALSE(find_leader(saloon_ahead(3.75), road::motorway()));
  const auto half_in = find_leader(saloon_ahead(2.2), road::motorway());
  REQUIRE(half_in);
  CHECK(half_in->participant == 2);
  const VehicleModel& saloon = vehicle_models()[*find_vehicle_model("saloon")];
  const VehicleModel& own = vehicle_models()[*find_vehicle_model("volvo-s80")];
  CHECK(half_in->distance_gap_m == relative(40.0 - saloon.rear_overhang_m - own.front_m(), 0.02));
}

}  // namespace septet::server
