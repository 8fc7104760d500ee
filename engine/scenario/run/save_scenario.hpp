#pragma once
/// A running scenario to bytes and back (engine/core/archive.hpp).

#include "engine/core/archive.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

void save_scenario(const ScenarioState& state, StateWriter& writer);

/// `state` comes as start_scenario leaves it: it says how much of everything there is. `reader` fails where it is no state of that
/// scenario: then `state` is not to be used.
void restore_scenario(const Scenario& scenario, const road::RoadNetwork& network, StateReader& reader,
                      ScenarioState& state);

}  // namespace septet::scenario
