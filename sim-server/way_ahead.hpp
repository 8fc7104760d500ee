#pragma once
/// What stands in the way of the storyboard's emergency vehicles.
///
/// A scripted entity drives where its script says, also into what the script does not know: traffic, the driver's car, what was
/// broken off. Whoever has the beacon or the siren on minds all of that, as its driver would (scenario::mind_the_way); what has fallen
/// on the road is driven over at walking pace. Everybody else stays the script's puppet, so that a scenario can stage an accident.

#include "sim-server/simulation.hpp"

namespace septet::server {

/// Tells the storyboard's emergency vehicles what they would drive into, as everybody stands in `snapshot`.
void look_ahead(const SimulationModel& model, const Snapshot& snapshot, const EffectsState& effects, scenario::ScenarioState& state);

}  // namespace septet::server
