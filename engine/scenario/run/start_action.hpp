#pragma once
/// What the start of an action does at once, and what it leaves running (OpenSCENARIO XML 1.3,
/// "Actions").

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"

namespace septet::scenario {

struct StartedAction {
  bool goes_on = false;                ///< The motion of an entity will end it; else it is done.
  std::vector<ElementIndex> replaced;  ///< Actions whose control of an entity it took over.
};

/// `action` is the action's storyboard element (no_element: Init). What it asks of others is added
/// to `result`.
StartedAction start_action(const Scenario& scenario, const road::RoadNetwork& network, const ActionVariant& what,
                           ElementIndex action, const std::vector<EntityIndex>& actors, ScenarioState& state,
                           StepResult& result);

}  // namespace septet::scenario
