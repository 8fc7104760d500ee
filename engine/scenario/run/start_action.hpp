#pragma once
/// The start of an action: its immediate effects, and the controls that it leaves running (OpenSCENARIO XML 1.3,
/// "Actions").

#include <vector>

#include "engine/road/road_network.hpp"
#include "engine/scenario/run/storyboard_runtime.hpp"

namespace septet::scenario {

struct StartedAction {
  bool goes_on = false;                ///< True: the motion of an entity will end it; false: it has ended.
  std::vector<ElementIndex> replaced;  ///< Actions whose control of an entity it has replaced.
};

/// `action` is the action's storyboard element (no_element: Init). Its requests to other stages are added to `result`.
StartedAction start_action(const Scenario& scenario, const road::RoadNetwork& network, const ActionVariant& what,
                           ElementIndex action, const std::vector<EntityIndex>& actors, ScenarioState& state,
                           StepResult& result);

}  // namespace septet::scenario
