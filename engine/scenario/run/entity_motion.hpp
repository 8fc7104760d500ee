#pragma once
/// The motion of the entities that a scenario drives: a follower of the road's lanes whose rear axle runs exactly where
/// the speed and lateral transitions say, with a heading tangent to its path.

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/resolve_position.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Puts an entity at a place; its controls of lane offset end, its speed stays.
void place_entity(EntityState& entity, const Placement& placement);

/// Starts a control in place of the running one (those of speed: speed_control.hpp). `action` is the requesting
/// storyboard element. False where the target lane does not exist.
bool start_lane_change(const road::RoadNetwork& network, const ScenarioState& state, const LaneChangeAction& what,
                       ElementIndex action, EntityState& entity);
void start_lateral_distance(const DistanceControl& control, ElementIndex action, EntityState& entity);
bool start_lane_offset(const road::RoadNetwork& network, const ScenarioState& state, const LaneOffsetAction& what,
                       ElementIndex action, EntityState& entity);

/// Moves an entity by dt. The storyboard elements of controls that came to their end are added to `ended`. False where
/// a number has become NaN or infinite: then the entity stands where it was, without controls.
bool move_entity(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state, double dt_s,
                 EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended);

}  // namespace septet::scenario
