#pragma once
/// Controls of the speed of a scripted entity: transitions, profiles, distances from others, meetings.

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Starts a control in place of the running one. `action` is the requesting storyboard element.
void start_speed(const Scenario& scenario, const ScenarioState& state, const SpeedAction& what, ElementIndex action,
                 EntityIndex who, EntityState& entity);
/// False where it ends at once.
bool start_speed_profile(const Scenario& scenario, const ScenarioState& state, const SpeedProfileAction& what,
                         ElementIndex action, EntityIndex who, EntityState& entity);
void start_distance(const DistanceControl& control, ElementIndex action, EntityState& entity);
/// False where a target or the master has no place.
bool start_synchronization(const road::RoadNetwork& network, const ScenarioState& state, const SynchronizeAction& what,
                           ElementIndex action, EntityState& entity);

/// The speed at the end of a step, and additional metres covered at once.
struct SpeedStep {
  double speed_mps = 0.0, jump_m = 0.0;
};
/// One step of the entity's control, except for obstacles in its path. A control that came to its end is added to
/// `ended`.
SpeedStep next_speed(const road::RoadNetwork& network, const Scenario& scenario, const ScenarioState& state,
                     double dt_s, EntityIndex who, EntityState& entity, std::vector<ElementIndex>& ended);

}  // namespace septet::scenario
