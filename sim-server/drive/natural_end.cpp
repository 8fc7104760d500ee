#include "sim-server/drive/natural_end.hpp"

#include "engine/road/plan_curve.hpp"
#include "engine/simulation/crash_recording.hpp"

namespace septet::server {
namespace {
constexpr double beyond_m = 10.0;  // More than a car's length: no part of a car is on the road any longer.
}

std::optional<logging::DriveEnd> natural_end(const simulation::Model& model, const simulation::State& state) {
  // An impact that has begun is driven to its end, so that its record is whole. A push may last as long as it likes.
  if (simulation::is_impact_running(state)) return std::nullopt;
  if (state.game && state.game->standing.end != GameEnd::none) return logging::DriveEnd::game_over;
  if (state.scenario.finished) return logging::DriveEnd::stop_trigger;
  if (state.car_road && is_beyond_road_end(model.roads, *state.car_road, state.car.world_from_body.position_m))
    return logging::DriveEnd::road_end;
  return std::nullopt;
}

bool is_beyond_road_end(const road::RoadNetwork& roads, const road::RoadPosition& place, const Vec2& world_m) {
  const road::Road& road = roads.roads[place.road];
  constexpr double at_m =
      0.01;  // A place beyond the end is reported at the end of the geometry, whose length may differ in the last bits.
  const bool at_end = place.s_m >= road.length_m - at_m;
  if (!at_end && place.s_m > at_m) return false;
  const road::RoadLink& link = at_end ? road.successor : road.predecessor;
  if (link.road != road::no_index || link.junction != road::no_index) return false;
  const road::PlanPoint end = road::evaluate_plan(road.plan, at_end ? road.length_m : 0.0);
  return glm::dot(world_m - end.position_m, at_end ? end.direction : -end.direction) > beyond_m;
}

}  // namespace septet::server
