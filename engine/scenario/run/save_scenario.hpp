#pragma once
/// A running scenario to bytes and back (engine/core/archive.hpp).

#include "engine/core/archive.hpp"
#include "engine/scenario/run/scenario_state.hpp"

namespace septet::scenario {

void save_scenario(const ScenarioState& state, StateWriter& writer);

/// `state` must be that of start_scenario: it gives the sizes of all lists. `reader` fails on data of another scenario:
/// then `state` is not to be used.
void restore_scenario(const Scenario& scenario, const road::RoadNetwork& network, StateReader& reader,
                      ScenarioState& state);

}  // namespace septet::scenario
