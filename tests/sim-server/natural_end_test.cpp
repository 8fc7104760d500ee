#include "sim-server/drive/natural_end.hpp"

#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "engine/road/plan_curve.hpp"
#include "engine/road/road_locate.hpp"
#include "engine/simulation/server_step.hpp"
#include "tests/sim-server/shipped_drive.hpp"

namespace septet::server {

TEST_CASE(
    "a car that is more than ten metres beyond the last road's end is beyond it and one at a joint of two roads is "
    "not") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  const road::RoadNetwork& roads = drive.model->roads;
  int open_ends = 0, joints = 0;
  for (road::RoadIndex index = 0; index < roads.roads.size(); ++index) {
    const road::Road& road = roads.roads[index];
    const road::PlanPoint end = road::evaluate_plan(road.plan, road.length_m);
    const bool is_open = road.successor.road == road::no_index && road.successor.junction == road::no_index;
    ++(is_open ? open_ends : joints);
    const road::RoadPosition at_end{index, road.length_m, 0.0};
    CHECK_FALSE(is_beyond_road_end(roads, at_end, end.position_m + 9.0 * end.direction));
    CHECK(is_beyond_road_end(roads, at_end, end.position_m + 11.0 * end.direction) == is_open);
    // Beside the road, however far, is not beyond its end.
    CHECK_FALSE(is_beyond_road_end(roads, {index, 0.5 * road.length_m, 0.0}, end.position_m + 11.0 * end.direction));
  }
  for (road::RoadIndex index = 0; index < roads.roads.size(); ++index) {
    const road::Road& road = roads.roads[index];
    const road::PlanPoint start = road::evaluate_plan(road.plan, 0.0);
    const bool is_open = road.predecessor.road == road::no_index && road.predecessor.junction == road::no_index;
    const road::RoadPosition at_start{index, 0.0, 0.0};
    CHECK_FALSE(is_beyond_road_end(roads, at_start, start.position_m + 11.0 * start.direction));
    CHECK_FALSE(is_beyond_road_end(roads, at_start, start.position_m - 9.0 * start.direction));
    CHECK(is_beyond_road_end(roads, at_start, start.position_m - 11.0 * start.direction) == is_open);
  }
  CHECK(open_ends > 0);
  MESSAGE(open_ends << " ends of roads are open, " << joints << " are not");
}

TEST_CASE("a drive ends where the car leaves the end of the road and where the storyboard stops") {
  const LoadedDrive drive = shipped_drive("behind-ambulance", "desktop");
  auto state = simulation::initial_state(*drive.model, traffic::own_traffic(drive.model->roads, 1));
  REQUIRE(state.has_value());
  std::vector<simulation::Event> events;
  simulation::server_step(*drive.model, {}, *state, events);
  CHECK_FALSE(natural_end(*drive.model, *state).has_value());
  // Where a road ends without a successor, in the lane beside the barrier in the middle, the car drives off the end: 30
  // m/s for a second.
  const road::RoadNetwork& roads = drive.model->roads;
  const auto open_end = std::ranges::find_if(roads.roads, [](const road::Road& road) {
    return road.successor.road == road::no_index && road.successor.junction == road::no_index;
  });
  REQUIRE(open_end != roads.roads.end());
  const auto index = static_cast<road::RoadIndex>(open_end - roads.roads.begin());
  const road::Road& road = *open_end;
  const road::PlanPoint end = road::evaluate_plan(road.plan, road.length_m);
  const Vec2 beside_m = end.position_m + 8.0 * Vec2(end.direction.y, -end.direction.x);
  const auto ground = road::surface_at(roads, beside_m - 0.1 * end.direction);
  REQUIRE(ground.has_value());
  const double yaw_rad = std::atan2(end.direction.y, end.direction.x);
  state->car.world_from_body.orientation = glm::angleAxis(yaw_rad, Vec3(0.0, 0.0, 1.0));
  state->car.world_from_body.position_m = Vec3(beside_m + 2.0 * end.direction, ground->height_m + 0.6);
  state->car.velocity_mps = Vec3(30.0 * end.direction, 0.0);
  state->car_road = road::RoadPosition{index, road.length_m, 0.0};
  int ticks = 0;
  while (!natural_end(*drive.model, *state) && ++ticks < 120) {
    simulation::server_step(*drive.model, {}, *state, events);
    state->scenario.finished = false;  // The storyboard stops near the road's end too.
  }
  INFO("on road " << (state->car_road ? static_cast<int>(state->car_road->road) : -1) << " of " << index << " at "
                  << (state->car_road ? state->car_road->s_m : 0.0) << " of " << road.length_m << ", ahead "
                  << glm::dot(Vec2(state->car.world_from_body.position_m) - end.position_m, end.direction));
  CHECK(natural_end(*drive.model, *state) == logging::DriveEnd::road_end);
  state->scenario.finished = true;
  CHECK(natural_end(*drive.model, *state) == logging::DriveEnd::stop_trigger);
}

}  // namespace septet::server
