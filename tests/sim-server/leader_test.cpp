#include <doctest/doctest.h>
#include <fmt/format.h>

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

TEST_CASE("headway and gap of the log are along the lane in which both drive, not along the reference line") {
  // Of five bends: both sides, both lanes, tight and wide; by the lane's radius times the angle between them.
  const struct {
    double curvature_per_m;
    int lane;
  } bends[] = {{0.02, -1}, {0.02, -2}, {-0.02, -1}, {1.0 / 150.0, -2}, {-1.0 / 400.0, -2}};
  for (const auto& bend : bends) {
    const double curvature = bend.curvature_per_m;
    const int lane = bend.lane;
    CAPTURE(curvature);
    CAPTURE(lane);
    const road::RoadNetwork roads = road::read_or_fail(road::SmallRoad{
        .length_m = 290.0, .geometry = road::arc(curvature), .sections = road::lane_section("", road::right_lanes(2))}
                                                           .xml());
    const VehicleModel& own = vehicle_models()[*find_vehicle_model("volvo-s80")];
    const VehicleModel& saloon = vehicle_models()[*find_vehicle_model("saloon")];
    const double own_s_m = 60.0, ahead_s_m = 112.0;
    Snapshot snapshot;
    for (const ParticipantId id : {1u, 2u}) {
      Participant body;
      body.id = id;
      body.model = *find_vehicle_model(id == 1 ? "volvo-s80" : "saloon");
      body.world_from_vehicle =
          road::world_from_lane(road::evaluate_lane(roads, {0, lane, id == 1 ? own_s_m : ahead_s_m, 0.0}));
      snapshot.participants.push_back(body);
    }
    const double stretch = 1.0 - curvature * (lane + 0.5) * 3.5;
    snapshot.driver_car.participant = 1;
    snapshot.driver_car.lane = lane;
    snapshot.driver_car.road_s_m = own_s_m + own.wheelbase_m / stretch;
    const auto leader = find_leader(snapshot, roads);
    REQUIRE(leader);
    const double between_m = (ahead_s_m - own_s_m) * stretch;
    CHECK(leader->distance_gap_m == relative(between_m - saloon.rear_overhang_m - own.front_m(), 1e-6));
    CHECK(leader->distance_headway_m == relative(between_m + saloon.front_m() - own.front_m(), 1e-6));
  }
}

}  // namespace septet::server
