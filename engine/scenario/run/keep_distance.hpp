#pragma once
/// LongitudinalDistanceAction and LateralDistanceAction (OpenSCENARIO XML 1.3): an entity's approach to a distance from
/// another, and keeping it. The standard names the bounds and the goal, not the approach: here a critically damped one
/// of 0.63 rad/s (2 rad/s sideways) that begins to slow down in time for its bounds. Pure functions.

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Metres by which the actor would have to move forwards, or to its left, to be at the distance; empty where the two
/// have no place or no path leads from one to the other. `side` is the target side of the reference: ahead or to the
/// left (1), or behind or to the right (−1). Along the lane's direction, so that a heading that swings does not count;
/// across, in the road's own coordinates where both are on one road and the action specifies "road" or "lane".
std::optional<double> way_to_distance_m(const road::RoadNetwork& network, const Scenario& scenario,
                                        const ScenarioState& state, const KeepDistanceAction& what, double side,
                                        EntityIndex actor);

/// Target side of the reference: the action's, else its present side.
double side_of_reference(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                         const KeepDistanceAction& what, EntityIndex actor);

/// The actor's speed forwards (or to the left) at the end of the step, with `way_m` left to go, where the goal itself
/// moves with `goal_mps`. `acceleration_mps2` is that of the step before.
double next_approach_mps(double way_m, double speed_mps, double goal_mps, double acceleration_mps2,
                         const DynamicConstraints& limits, bool lateral, double dt_s);

/// True where the distance is reached in this step.
bool is_at_distance(double way_m, double closing_mps, double dt_s);

}  // namespace septet::scenario
