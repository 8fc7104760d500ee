#pragma once
/// Evaluation of triggers (OpenSCENARIO XML 1.3, "Conditions and triggers").

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

/// Evaluates every condition, so that each sees its edges, and returns whether any group holds. Changes only the states
/// of the conditions. A trigger without groups does not hold.
bool evaluate_trigger(const Scenario& scenario, const road::RoadNetwork& network, const Trigger& trigger,
                      ScenarioState& state);

/// Resets the conditions' states, as when an event goes back to standby in a new round of its maneuver group.
void forget_trigger(const Trigger& trigger, ScenarioState& state);

}  // namespace septet::scenario
