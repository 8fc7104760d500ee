#include <algorithm>

#include <doctest/doctest.h>

#include "engine/effects/debris/piece.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/simulation/effects/body_box.hpp"
#include "engine/simulation/effects/crashes.hpp"
#include "engine/simulation/effects/effect_surroundings.hpp"
#include "engine/simulation/server_step.hpp"
#include "tests/relative.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::simulation {
namespace {

/// A scenario's road without traffic, and its ambulance.
struct EmptyRoad {
  server::LoadedDrive drive;
  std::vector<Event> events;
  State state;
  scenario::EntityIndex ambulance = scenario::no_entity;
  Snapshot now;

  explicit EmptyRoad(const std::string& scenario = "rescue-lane") : drive(server::shipped_drive(scenario, "desktop")) {
    auto begun = initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
    REQUIRE(begun.has_value());
    state = std::move(*begun);
    state.traffic->stop();
    for (scenario::EntityIndex i = 0; i < drive.model->scenario.entities.size(); ++i)
      if (drive.model->scenario.entities[i].name == "ambulance") ambulance = i;
    REQUIRE(ambulance != scenario::no_entity);
  }
  scenario::EntityState& entity() { return state.scenario.entities[ambulance]; }
  /// The driver's car, at rest, so far ahead of the ambulance and so far to its left.
  void put_car(double ahead_m, double left_m, double speed_mps = 0.0) {
    road::LanePosition lane = entity().lane;
    lane.s_m += ahead_m;
    lane.offset_m += left_m;
    const RigidTransform pose = scenario::lane_pose(drive.model->roads, lane, true, 0.0, 0.0);
    state.car = vehicle::standstill(drive.model->car, pose, speed_mps);
    state.car_road.reset();
  }
  /// The driver's car beside the ambulance, its middle so far to the left, as fast.
  void keep_beside(double left_m, double seconds) {
    for (int tick = 0; tick < seconds * tick_rate_hz; ++tick) {
      put_car(0.0, left_m, entity().speed_mps);
      drive_for(1.0 / tick_rate_hz);
      hardest_mps2 = std::min(hardest_mps2, entity().acceleration_mps2);
    }
  }
  double hardest_mps2 = 0.0;
  void drive_for(double seconds) {
    DriverInput input;
    input.brake = 0.5;
    for (int tick = 0; tick < seconds * tick_rate_hz; ++tick) {
      now = server_step(*drive.model, input, state, events);
      const Participant* car = find_participant(now, driver_participant);
      const Participant* other = find_participant(now, first_scripted_participant + ambulance);
      if (other && contact_of(body_box(*car), body_box(*other))) touched = true;
    }
  }
  bool touched = false;
};

}  // namespace

TEST_CASE("an ambulance stops behind a car that stands in its way and goes on when the way is clear") {
  EmptyRoad road;
  road.drive_for(10.0);  // It hurries.
  CHECK(road.entity().speed_mps > 19.0);
  road.put_car(150.0, 0.5);
  road.drive_for(25.0);
  CHECK_FALSE(road.touched);
  CHECK(road.entity().speed_mps < 0.5);
  const auto& p =
      find_participant(road.now, first_scripted_participant + road.ambulance)->world_from_vehicle.position_m;
  const double away_m = glm::distance(p, find_participant(road.now, driver_participant)->world_from_vehicle.position_m);
  CHECK(away_m > 6.0);
  CHECK(away_m < 12.0);
  road.put_car(8.0, 4.5);  // Aside.
  road.drive_for(20.0);
  CHECK_FALSE(road.touched);
  CHECK(road.entity().speed_mps > 20.0);
}

TEST_CASE("an ambulance passes a car that leaves it room without braking") {
  EmptyRoad road;
  road.drive_for(12.0);
  const double before_mps = road.entity().speed_mps;
  road.put_car(120.0, 2.4);
  road.drive_for(6.0);
  CHECK_FALSE(road.touched);
  CHECK(road.entity().speed_mps > before_mps - 0.1);
}

TEST_CASE(
    "an ambulance does not move over into a car beside it nor brake hard for it but waits until that place is free") {
  EmptyRoad road("behind-ambulance");
  while (!road.entity().lateral_control.active ||
         road.now.simulated_time_s < 10.0) {  // Between the lanes first; then back.
    road.drive_for(1.0 / tick_rate_hz);
    REQUIRE(road.now.simulated_time_s < 60.0);
  }
  // Its action's target, known to the lane's offset; a car is 3 m beside the body's middle there.
  const auto& control = road.entity().lateral_control.transition;
  const double aside_m = control.to > control.from ? 3.0 : -3.0;
  const double before_m = road.entity().lane.offset_m;
  road.keep_beside(aside_m, 4.0);
  CHECK(scenario::has_yet_to_move_aside(road.entity()));
  CHECK(road.entity().lane.offset_m == relative(before_m, 0.001));
  CHECK_FALSE(road.touched);
  CHECK(road.hardest_mps2 > -2.5);
  road.put_car(-150.0, 0.0);
  road.drive_for(6.0);
  CHECK_FALSE(scenario::has_yet_to_move_aside(road.entity()));
  CHECK(std::abs(road.entity().lane.offset_m - before_m) > 1.0);
}

TEST_CASE("a car across the whole bend is minded where the bend leads and not straight ahead") {
  EmptyRoad road;
  road.drive_for(10.0);
  for (const double ahead_m : {60.0, 120.0}) {
    road.put_car(ahead_m, 0.0);
    road.drive_for(1.0 / tick_rate_hz);
    REQUIRE(road.entity().in_the_way.has_value());
    CHECK(road.entity().in_the_way->gap_m == relative(ahead_m - 5.9, 0.05));
  }
}

TEST_CASE("an ambulance drives over what lies on the road at walking pace and hurries on behind it") {
  EmptyRoad road;
  road.drive_for(10.0);
  road::LanePosition lane = road.entity().lane;
  lane.s_m += 90.0;
  RigidTransform pose = scenario::lane_pose(road.drive.model->roads, lane, true, 0.0, 0.0);
  pose.position_m.z += 0.045;
  debris::spawn_part(road.state.effects.debris, debris::Part::ice_slab, pose, Vec3(0.0), Vec3(0.0),
                     road.state.effects.random);
  const double before_m = road.entity().travelled_m;
  double slowest_mps = 1e9;
  while (road.entity().travelled_m < before_m + 95.0) {
    road.drive_for(0.1);
    slowest_mps = std::min(slowest_mps, road.entity().speed_mps);
    REQUIRE(road.now.simulated_time_s < 60.0);
  }
  CHECK(slowest_mps < 4.0);
  CHECK(slowest_mps > 1.0);
  road.drive_for(15.0);
  CHECK(road.entity().speed_mps > 18.0);
}

TEST_CASE("an ambulance that comes to the end of its road leaves, the log says so, and the drive goes on") {
  EmptyRoad road;
  road.drive_for(0.5);
  CHECK(find_participant(road.now, first_scripted_participant + road.ambulance) != nullptr);
  road::LanePosition& lane = road.entity().lane;
  lane.s_m = road.drive.model->roads.roads[lane.road].length_m - 1.0;
  // On to the last road of the chain.
  while (true) {
    const auto next = scenario::go_along(road.drive.model->roads, lane, road.entity().along_s, 5000.0);
    lane = next.lane;
    if (next.left_over_m > 0.0) break;
  }
  lane.s_m -= 5.0;
  road.drive_for(1.0);
  CHECK(find_participant(road.now, first_scripted_participant + road.ambulance) == nullptr);
  CHECK(std::ranges::count(road.events, "entity=ambulance state=left_at_road_end", &Event::detail) == 1);
  road.drive_for(1.0);
  CHECK(std::ranges::count(road.events, "entity=ambulance state=left_at_road_end", &Event::detail) == 1);
}

}  // namespace septet::simulation
