#pragma once
/// The motion of an entity along the path of a trajectory, anywhere: upright on the surface below it.

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Lays the trajectory out from the entities' present places. False where it has no path.
bool start_path(const road::RoadNetwork& network, const ScenarioState& state, const FollowTrajectoryAction& what,
                ElementIndex action, EntityState& entity);

/// Advances by one step: `way_m` along the path, or to the place of its times, which gives the speed. At its end the
/// entity continues along the lane in which it stands, if any, keeping its place across it. Returns the metres
/// travelled; a control that came to its end is added to `ended`.
double follow_path(const road::RoadNetwork& network, double way_m, double dt_s, EntityState& entity,
                   std::vector<ElementIndex>& ended);

}  // namespace septet::scenario
