#pragma once
/// What stands in the way of the storyboard's emergency vehicles.
///
/// A scripted entity drives where its script says, also into what the script does not know: traffic, the driver's car, what was
/// broken off. Whoever has the beacon or the siren on minds all of that, as its driver would (scenario::mind_the_way); what has fallen
/// on the road is driven over at walking pace. Everybody else stays the script's puppet, so that a scenario can stage an accident.

#include "engine/simulation/state.hpp"

namespace septet::simulation {

/// Tells the storyboard's emergency vehicles what they would drive into, as everybody stands now.
void look_ahead(const Model& model, const std::vector<Participant>& participants, const EffectsState& effects,
                scenario::ScenarioState& state);

}  // namespace septet::simulation
