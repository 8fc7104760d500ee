#pragma once
/// Obstacles in the path of the storyboard's emergency vehicles.
///
/// A scripted entity drives its script's path, also into objects unknown to the script: traffic, the driver's car,
/// debris. An entity with its beacon or siren on avoids all of them, as its driver would (scenario::mind_the_way);
/// debris on the road is driven over at walking pace. All other entities stay the script's puppets until they crash, so
/// that a scenario can stage an accident.

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Passes the storyboard's emergency vehicles the obstacles ahead, from all present positions.
void look_ahead(const Model& model, const std::vector<Participant>& participants, const EffectsState& effects,
                scenario::ScenarioState& state);

}  // namespace septet::simulation
