#include "engine/scenario/run/save_scenario.hpp"

#include <cmath>

#include "engine/road/position_members.hpp"
#include "engine/scenario/run/path.hpp"
#include "engine/scenario/run/route.hpp"
#include "engine/scenario/run/speed_profile.hpp"
#include "engine/scenario/run/synchronize.hpp"
#include "engine/world/world_members.hpp"

namespace septet::scenario {

SEPTET_MEMBERS(Transition, shape, over_distance, extent, progress, from, to)
SEPTET_MEMBERS(DynamicConstraints, max_speed_mps, max_acceleration_mps2, max_deceleration_mps2,
               max_acceleration_rate_mps3, max_deceleration_rate_mps3)
SEPTET_MEMBERS(KeepDistanceAction, lateral, reference, distance_m, time_gap_s, reference_side, system, freespace,
               continuous, limits)
SEPTET_MEMBERS(DistanceControl, what, side)
SEPTET_MEMBERS(SpeedProfile::Phase, start_s, speed_mps, acceleration_mps2, jerk_mps3)
SEPTET_MEMBERS(SpeedProfile, phases, end_s, end_mps)
SEPTET_MEMBERS(Placement, on_road, lane, along_s, heading_offset_rad, pose)
SEPTET_MEMBERS(Meeting, target, master_target, what)
SEPTET_MEMBERS(SpeedControl, active, action, transition, follow, follow_factor, follow_delta_mps, profile, profile_s,
               distance, meeting)
SEPTET_MEMBERS(LateralControl, active, action, transition, lane_change, to_the_left, distance, left_mps, left_mps2,
               left_way_m)
SEPTET_MEMBERS(InTheWay, gap_m, speed_mps)
SEPTET_MEMBERS(PathPoint, s_m, position_m, heading_rad, time_s)
SEPTET_MEMBERS(Path, points)
// Data derived once from the scenario, and its values, is kept.
SEPTET_MEMBER_GROUPS(PathControl, hashed(active, action), kept(path), hashed(timed, clock_s, station_m))
SEPTET_MEMBER_GROUPS(RouteState, kept(roads), hashed(at))
SEPTET_MEMBERS(Waypoint, lane, along_s)
SEPTET_MEMBERS(PlannedRoute, waypoints, roads)
// A step is only seen.
SEPTET_MEMBER_GROUPS(EntityState,
                     hashed(active, external, on_road, lane, along_s, heading_offset_rad, world_from_entity, speed_mps,
                            acceleration_mps2, velocity_mps, acceleration_vector_mps2, angular_velocity_radps,
                            in_the_way, beside_is_taken, held_back_mps, travelled_m, at_road_end_s, standing_s,
                            wheel_angle_rad),
                     kept(strides), hashed(lamps, speed_control, lateral_control, path_control, route))
SEPTET_MEMBERS(ElementState, initialised, status, last_transition, transition_sequence, executions)
SEPTET_MEMBERS(ConditionState::Change, time_s, value)
SEPTET_MEMBERS(ConditionState, evaluated, last_value, sequence, delayed_value, delayed)
SEPTET_MEMBER_GROUPS(ScenarioState,
                     hashed(time_s, sequence, step_sequence, finished, environment, friction_scale, entities, values),
                     kept(routes), hashed(elements, conditions))
// The positions behind a meeting's placements are not needed any more.
SEPTET_MEMBER_GROUPS(SynchronizeAction, hashed(master), left_out(target, master_target),
                     hashed(tolerance_m, master_tolerance_m, final_speed, final_value, steady_m, steady_s))

namespace {

constexpr auto wrong = "the storyboard in it does not fit together";
constexpr std::size_t longest_value = 1 << 16;

struct Bounds {
  const road::RoadNetwork& network;
  std::size_t entities, elements;
};

void require_entity(const Bounds& bounds, EntityIndex entity, StateReader& reader) {
  reader.require(entity < bounds.entities, wrong);
}

void require_action(const Bounds& bounds, ElementIndex action, StateReader& reader) {
  reader.require(action == no_element || action < bounds.elements, wrong);
}

void require_whole(const Bounds& bounds, const Placement& placement, StateReader& reader) {
  if (placement.on_road) road::require_on_roads(reader, bounds.network, placement.lane);
}

void require_roads(const Bounds& bounds, const std::vector<road::RoadIndex>& roads, StateReader& reader) {
  for (const road::RoadIndex road : roads) reader.require(road < bounds.network.roads.size(), wrong);
}

void require_whole(const Bounds& bounds, const SpeedControl& control, StateReader& reader) {
  require_action(bounds, control.action, reader);
  if (control.follow != no_entity) require_entity(bounds, control.follow, reader);
  if (control.profile) reader.require(!control.profile->phases.empty(), wrong);
  if (control.distance) require_entity(bounds, control.distance->what.reference, reader);
  if (!control.meeting) return;
  require_entity(bounds, control.meeting->what.master, reader);
  require_whole(bounds, control.meeting->target, reader);
  require_whole(bounds, control.meeting->master_target, reader);
}

void require_whole(const Bounds& bounds, const EntityState& entity, StateReader& reader) {
  road::require_on_roads(reader, bounds.network, entity.lane);
  reader.require(std::isfinite(entity.speed_mps) && std::isfinite(entity.acceleration_mps2), wrong);
  require_whole(bounds, entity.speed_control, reader);
  require_action(bounds, entity.lateral_control.action, reader);
  if (entity.lateral_control.distance) require_entity(bounds, entity.lateral_control.distance->what.reference, reader);
  const PathControl& path = entity.path_control;
  require_action(bounds, path.action, reader);
  reader.require(path.path ? path.path->points.size() >= 2 : !path.active, wrong);
  if (!entity.route.roads) return;
  require_roads(bounds, *entity.route.roads, reader);
  reader.require(entity.route.at < std::max<std::size_t>(entity.route.roads->size(), 1), wrong);
}

}  // namespace

void save_scenario(const ScenarioState& state, StateWriter& writer) { transfer(writer, state); }

void add_to_hash(const ScenarioState& state, StateHash& hash) { hash_members(hash, state); }

void restore_scenario(const Scenario& scenario, const road::RoadNetwork& network, StateReader& reader,
                      ScenarioState& state) {
  const std::size_t conditions = state.conditions.size(), elements = state.elements.size(),
                    routes = state.routes.size(), values = state.values.size();
  transfer(reader, state);
  const Bounds bounds{network, scenario.entities.size(), elements};
  reader.require(state.entities.size() == bounds.entities && state.elements.size() == elements &&
                     state.conditions.size() == conditions && state.routes.size() == routes &&
                     state.values.size() == values,
                 "its storyboard is that of another scenario");
  for (const EntityState& entity : state.entities) require_whole(bounds, entity, reader);
  for (const std::string& value : state.values) reader.require(value.size() <= longest_value, wrong);
  for (const auto& route : state.routes) {
    if (!route) continue;
    require_roads(bounds, route->roads, reader);
    for (const Waypoint& waypoint : route->waypoints) road::require_on_roads(reader, network, waypoint.lane);
  }
}

}  // namespace septet::scenario
