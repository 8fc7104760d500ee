#pragma once
/// The motion of an entity along the path of a trajectory, wherever that leads: upright on whatever surface is below it.

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Lays the trajectory out from where everybody is now. False where it leads nowhere.
bool start_path(const road::RoadNetwork& network, const ScenarioState& state, const FollowTrajectoryAction& what,
                ElementIndex action, EntityState& entity);

/// One step: `way_m` along the path, or what its times ask for, which becomes the speed. At its end the entity goes on along the lane
/// in which it stands, if it does, as it stands in it. Answers the metres that it went; a control that came to its end is added
/// to `ended`.
double follow_path(const road::RoadNetwork& network, double way_m, double dt_s, EntityState& entity,
                   std::vector<ElementIndex>& ended);

}  // namespace septet::scenario
